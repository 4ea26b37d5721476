#include "fusion/live/live_reconstruction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "graph/io/graph_io.h"
#include "kernel/parallel.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

// The first bundles of the shared scan of a wire cube, 3 m of wire.
class LiveCube : public testing::Test {
 protected:
  void SetUp() override {
    const auto folder = SharedData("sim/cubeframe");
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
    scan_ = OpenSequence(folder);
  }

  LiveReconstruction Start() const { return {scan_, DefaultBestOptions()}; }
  // Returns how often a bundle ended.
  int Add(int first, int last, LiveReconstruction& live) const {
    int bundles = 0;
    for (int i = first; i < last; ++i) bundles += live.AddFrame(scan_.frames[i]);
    return bundles;
  }

  Sequence scan_;
};

TEST_F(LiveCube, NothingIsShownBeforeTheFirstBundle) {
  LiveReconstruction live = Start();
  EXPECT_EQ(Add(0, 29, live), 0);
  EXPECT_TRUE(live.Snapshot().graph.empty());
  EXPECT_EQ(Add(29, 30, live), 1);
  EXPECT_FALSE(live.Snapshot().graph.empty());
}

TEST_F(LiveCube, SnapshotsGrowAndTellWhatTheyRestOn) {
  LiveReconstruction live = Start();
  Add(0, 30, live);
  const LiveSnapshot first = live.Snapshot();
  Add(30, 60, live);
  const LiveSnapshot second = live.Snapshot();
  // The first second has seen the whole cube already.
  EXPECT_GT(second.graph.TotalLength(), 0.9 * first.graph.TotalLength());
  ASSERT_EQ(second.curves.size(), static_cast<size_t>(second.graph.edge_count()));
  const std::vector<EdgeId> edges = second.graph.Edges();
  int most_frames = 0, most_before = 0;
  for (const CurveSightings& seen : first.curves) most_before = std::max(most_before, seen.frames);
  for (size_t i = 0; i < edges.size(); ++i) {
    const CurveSightings& seen = second.curves[i];
    const SkeletonEdge& edge = second.graph.edge(edges[i]);
    for (int end = 0; end < 2; ++end) {
      EXPECT_EQ(seen.free_ends[end], second.graph.Degree(edge.nodes[end]) == 1);
    }
    EXPECT_GE(seen.evidence, 0);
    EXPECT_LE(seen.evidence, 1);
    EXPECT_EQ(seen.evidence, EvidenceOf(seen.frames, seen.spread));
    most_frames = std::max(most_frames, seen.frames);
  }
  EXPECT_LE(most_before, 15);  // every second of 30 is looked at
  EXPECT_GT(most_frames, most_before);
  EXPECT_LE(most_frames, 30);
}

// The cube's wires are seen again and again: what is kept of them does not grow.
TEST_F(LiveCube, MemoryDoesNotGrowWithTheFrames) {
  LiveReconstruction live = Start();
  Add(0, 30, live);
  const size_t points = live.evidence().carried.points().size();
  const int cells = live.evidence().sightings.cell_count();
  const size_t volume = live.volume_bytes();
  for (int time = 0; time < 3; ++time) Add(0, 30, live);
  // Registration moves some points into cells beside theirs.
  EXPECT_LT(live.evidence().carried.points().size(), 1.5 * points);
  EXPECT_LT(live.evidence().sightings.cell_count(), 1.5 * cells);
  EXPECT_LT(live.volume_bytes(), 1.1 * volume);
  EXPECT_LE(live.sample().frame_count(), 64);
}

TEST_F(LiveCube, TheSameBytesForAnyNumberOfThreads) {
  std::vector<std::string> snapshots;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    LiveReconstruction live = Start();
    Add(0, 30, live);
    snapshots.push_back(SkeletonToJson(live.Snapshot().graph));
  }
  EXPECT_EQ(snapshots[0], snapshots[1]);
}

TEST(LiveEvidence, TheRarerOfFramesAndSidesDecides) {
  constexpr double kPi = 3.14159265358979;
  EXPECT_EQ(EvidenceOf(0, kPi), 0);
  EXPECT_EQ(EvidenceOf(1000, 0), 0);
  EXPECT_DOUBLE_EQ(EvidenceOf(15, kPi), 1);
  EXPECT_NEAR(EvidenceOf(1000, kPi / 6), 0.5, 1e-12);
  EXPECT_LT(EvidenceOf(5, kPi), EvidenceOf(10, kPi));
}

TEST(LiveSnapshot, OfNothingIsEmpty) {
  const LiveSnapshot snapshot = MakeSnapshot({}, DefaultBestOptions());
  EXPECT_TRUE(snapshot.graph.empty());
  EXPECT_TRUE(snapshot.curves.empty());
}

}  // namespace
}  // namespace curvefusion
