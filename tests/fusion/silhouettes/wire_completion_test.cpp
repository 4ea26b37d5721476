#include "fusion/silhouettes/wire_completion.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "kernel/parallel.h"
#include "tests/fusion/wire_images.h"

namespace curvefusion {
namespace {

constexpr int kFrames = 6;
constexpr double kRadius = 0.0025;

// Two bars along x, 50 mm apart, and two wires across both of them, at x = -.03 and .03.
std::vector<RenderedWire> Ladder(bool with_second_wire) {
  const Rgb color{60, 160, 70};
  std::vector<RenderedWire> wires = {
      {{-0.08, -0.025, 0.5}, {0.08, -0.025, 0.5}, 2 * kRadius, color},
      {{-0.08, 0.025, 0.5}, {0.08, 0.025, 0.5}, 2 * kRadius, color},
      {{-0.03, -0.07, 0.5}, {-0.03, 0.07, 0.5}, 2 * kRadius, color},
      {{0.03, -0.07, 0.5}, {0.03, -0.025, 0.5}, 2 * kRadius, color}};
  if (with_second_wire) {
    wires.push_back({{0.03, -0.025, 0.5}, {0.03, 0.07, 0.5}, 2 * kRadius, color});
  }
  return wires;
}

// The ladder as depth saw it: both wires end at the first bar.
SkeletonGraph SeenLadder() {
  SkeletonGraph graph;
  const auto connect = [&graph](NodeId a, NodeId b) {
    SkeletonEdge edge{{a, b}, Resample({graph.position(a), graph.position(b)}, 0.001), {}, {}};
    edge.radii.assign(edge.points.size(), kRadius);
    graph.AddEdge(std::move(edge));
  };
  const NodeId first = graph.AddNode({-0.03, -0.025, 0.5});
  const NodeId second = graph.AddNode({0.03, -0.025, 0.5});
  connect(graph.AddNode({-0.08, -0.025, 0.5}), first);
  connect(first, second);
  connect(second, graph.AddNode({0.08, -0.025, 0.5}));
  connect(graph.AddNode({-0.03, -0.07, 0.5}), first);
  connect(graph.AddNode({0.03, -0.07, 0.5}), second);
  connect(graph.AddNode({-0.08, 0.025, 0.5}), graph.AddNode({0.08, 0.025, 0.5}));
  return graph;
}

// Rendered images of ladders whose second wire goes on, or ends at the first bar.
class CompleteWiresTest : public testing::Test {
 protected:
  static PinholeCamera Camera() { return {320, 240, 480, 480, 159.5, 119.5}; }

  static RigidTransform Pose(int frame) {
    RigidTransform T = RigidTransform::Identity();
    T.linear() =
        Eigen::AngleAxisd(0.08 * (frame - kFrames / 2), Vec3(1, 0.5, 0).normalized()).matrix();
    T.translation() = Vec3(0, 0, 0.5) - T.linear() * Vec3(0, 0, 0.5);
    return T;
  }

  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("curvefusion_wire_completion_{}", getpid());
    std::filesystem::create_directories(folder_);
    for (int i = 0; i < kFrames; ++i) {
      for (const bool whole : {false, true}) {
        WriteImage(ImagePath(i, whole), RenderWires(Ladder(whole), Camera(), Pose(i), 0.8));
      }
    }
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  static std::filesystem::path ImagePath(int i, bool whole) {
    return folder_ / fmt::format("{}{}.png", whole ? "whole" : "part", i);
  }

  static Sequence Scan(bool whole) {
    Sequence sequence;
    sequence.depth_camera = sequence.color_camera = Camera();
    for (int i = 0; i < kFrames; ++i) {
      SequenceFrame frame;
      frame.timestamp = i;
      frame.T_world_camera = Pose(i);
      frame.color_path = ImagePath(i, whole);
      sequence.frames.push_back(frame);
    }
    return sequence;
  }

  inline static std::filesystem::path folder_;
};

TEST_F(CompleteWiresTest, AddsWhatTheImagesShow) {
  const CompletedWires completed = CompleteWires(SeenLadder(), Scan(true), {});
  EXPECT_EQ(completed.added, 2);
  EXPECT_EQ(completed.skeleton.CycleRank(), 1);
  for (const EdgeId id : completed.skeleton.Edges()) {
    const SkeletonEdge& edge = completed.skeleton.edge(id);
    for (const Vec3& p : edge.points) {
      const double to_wire =
          std::min(std::abs(std::abs(p.x()) - 0.03), std::abs(std::abs(p.y()) - 0.025));
      EXPECT_LT(to_wire, 0.0016);  // curves are sampled every 1.5 mm
    }
  }
}

TEST_F(CompleteWiresTest, AddsNothingWhereTheImagesShowNothing) {
  const CompletedWires completed = CompleteWires(SeenLadder(), Scan(false), {});
  EXPECT_EQ(completed.added, 1);
  EXPECT_EQ(completed.rejected, 1);
  EXPECT_EQ(completed.skeleton.CycleRank(), 0);
}

TEST_F(CompleteWiresTest, LeavesCurvesOfUnknownRadiusAlone) {
  SkeletonGraph skeleton = SeenLadder();
  for (const EdgeId id : skeleton.Edges()) skeleton.SetCurve(id, skeleton.edge(id).points);
  EXPECT_EQ(CompleteWires(skeleton, Scan(true), {}).added, 0);
  EXPECT_EQ(CompleteWires({}, Scan(true), {}).added, 0);
}

TEST_F(CompleteWiresTest, DoesNotDependOnTheNumberOfThreads) {
  SkeletonGraph results[2];
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    results[threads - 1] = CompleteWires(SeenLadder(), Scan(true), {}).skeleton;
  }
  ASSERT_EQ(results[0].Edges(), results[1].Edges());
  for (const EdgeId id : results[0].Edges()) {
    EXPECT_EQ(results[0].edge(id).points, results[1].edge(id).points);
  }
}

}  // namespace
}  // namespace curvefusion
