#include "experiments/simulation/simulate.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>

#include "capture/sequence.h"
#include "graph/io/graph_io.h"
#include "kernel/error.h"
#include "kernel/parallel.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> Simulated(const SimulationOptions& options, int threads) {
  const TemporaryFolder folder;
  const ThreadLimit limit(threads);
  SimulateScan(options, folder.path(), NoProgress);
  return FileContents(folder.path());
}

// From a point to the nearest wire's surface.
double DistanceToWires(const SkeletonGraph& graph, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    nearest = std::min(nearest, std::abs(Project(edge.points, p).distance - edge.radii.front()));
  }
  return nearest;
}

TEST(SimulateScan, SameBytesForAnyNumberOfThreads) {
  SimulationOptions options;
  options.frames = 3;
  const auto one = Simulated(options, 1);
  const auto four = Simulated(options, 4);
  EXPECT_EQ(one.size(), 3u * 2 + 5 + 5);
  EXPECT_TRUE(one == four);
}

TEST(SimulateScan, SeedsDifferAndSensorsShareTheSceneAndMotion) {
  SimulationOptions options;
  options.frames = 1;
  options.sensor = "ideal";
  const auto first = Simulated(options, 0);
  options.seed = 2;
  const auto second = Simulated(options, 0);
  EXPECT_NE(first.at("truth/trajectory.txt"), second.at("truth/trajectory.txt"));
  EXPECT_NE(first.at("depth/1000.000000.png"), second.at("depth/1000.000000.png"));
  options.pose_source = "ptam";
  options.frames = 2;
  const auto other_poses = Simulated(options, 0);
  EXPECT_EQ(other_poses.at("depth/1000.000000.png"), second.at("depth/1000.000000.png"));
  EXPECT_NE(other_poses.at("trajectory.txt"), other_poses.at("truth/trajectory.txt"));
}

TEST(SimulateScan, WritesTruthThatReadsBack) {
  const TemporaryFolder folder;
  SimulationOptions options;
  options.object = "cage";
  options.sensor = "ideal";
  options.frames = 1;
  SimulateScan(options, folder.path(), NoProgress);
  const SkeletonGraph truth = ReadSkeleton(folder.path() / "truth" / "skeleton.json");
  EXPECT_EQ(truth.CycleRank(), 41);
  EXPECT_DOUBLE_EQ(truth.edge(truth.Edges()[0]).radii[0], 0.00225);
}

TEST(SimulateScan, IsASequenceTheReaderTakes) {
  const TemporaryFolder folder;
  SimulationOptions options;
  options.sensor = "ideal";
  options.pose_source = "true";
  options.large_color = true;
  options.frames = 2;
  SimulateScan(options, folder.path(), NoProgress);
  const Sequence sequence = OpenSequence(folder.path());
  ASSERT_EQ(sequence.frame_count(), 2);
  EXPECT_EQ(sequence.depth_camera.fx, 580);
  EXPECT_EQ(sequence.color_camera.fx, 1160);
  EXPECT_EQ(LoadColor(sequence, 0).height(), 1024);
  // With true poses and exact depth, a pixel on a wire's centre line shows that wire or one before
  // it, one radius off the centre line. 0.15 mm: the file rounds depth to 0.2 mm.
  const SkeletonGraph truth = ReadSkeleton(folder.path() / "truth" / "skeleton.json");
  const DepthImage depth = LoadDepth(sequence, 1);
  const RigidTransform& T_world_camera = sequence.frames[1].T_world_camera;
  for (const EdgeId id : truth.Edges()) {
    for (const Vec3& p_world : Resample(truth.edge(id).points, 0.01)) {
      const Vec2 pixel = sequence.depth_camera.Project(T_world_camera.inverse() * p_world);
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      const Vec3 seen = T_world_camera * sequence.depth_camera.Unproject(u, v, depth(u, v));
      EXPECT_LT(DistanceToWires(truth, seen), 0.00015);
    }
  }
}

// The told camera reads back; of a raw scan nothing is told, so colour seems registered.
TEST(SimulateScan, AColorCameraOfItsOwnIsToldUnlessRaw) {
  SimulationOptions options;
  options.sensor = "ideal";
  options.frames = 1;
  for (const Registration registration : {Registration::kExact, Registration::kRaw}) {
    const TemporaryFolder folder;
    options.color.registration = registration;
    SimulateScan(options, folder.path(), NoProgress);
    const Sequence sequence = OpenSequence(folder.path());
    const bool told = registration == Registration::kExact;
    EXPECT_EQ(sequence.color_camera.fx, told ? 525 : sequence.depth_camera.fx);
    EXPECT_EQ(sequence.T_color_depth.translation().x(), told ? -0.025 : 0);
  }
}

TEST(SimulateScan, InterruptedScanLeavesNothing) {
  const TemporaryFolder folder;
  SimulationOptions options;
  options.sensor = "ideal";
  options.frames = 3;
  const Progress interrupt = [](std::string_view, int64_t done, int64_t) {
    if (done == 2) throw Error(ErrorKind::kInterrupted, "stop");
  };
  EXPECT_THROW(SimulateScan(options, folder.path() / "scan", interrupt), Error);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SimulateScan, AnEarlierScanIsLeftAlone) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "associations.txt") << "of an earlier scan";
  SimulationOptions options;
  options.sensor = "ideal";
  options.frames = 1;
  EXPECT_THROW(SimulateScan(options, folder.path(), NoProgress), Error);
  EXPECT_EQ(FileContents(folder.path()).size(), 1u);
}

TEST(SimulateScan, RefusesWhatCannotBe) {
  SimulationOptions options;
  options.frames = 0;
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  options.frames = 1;
  options.readout_time = 0.04;
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  options.readout_time = 0;
  options.color.exposure_time = 0.04;
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  options.color.exposure_time = 0;
  options.motion.standoff = 5;  // a Kinect V1 ends at 4 m
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  options.motion.standoff = 0;
  options.object = "parallel_wires";  // of 5 mm
  options.object_options.spacing = 0.005;
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  options.object = "teapot";
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  EXPECT_FALSE(fs::exists("unused"));
}

}  // namespace
}  // namespace curvefusion
