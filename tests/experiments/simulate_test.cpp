#include "experiments/simulation/simulate.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

#include "graph/graph_io.h"
#include "kernel/error.h"
#include "kernel/parallel.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name) : path_(fs::temp_directory_path() / name) {
    fs::remove_all(path_);
  }
  ~TemporaryFolder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::map<std::string, std::string> Contents(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    contents[fs::relative(entry.path(), folder).string()] =
        std::string(std::istreambuf_iterator<char>(stream), {});
  }
  return contents;
}

std::map<std::string, std::string> Simulated(const SimulationOptions& options, int threads,
                                             const std::string& name) {
  const TemporaryFolder folder("curvefusion_simulate_test_" + name);
  const ThreadLimit limit(threads);
  SimulateScan(options, folder.path(), NoProgress);
  return Contents(folder.path());
}

TEST(SimulateScan, SameBytesForAnyNumberOfThreads) {
  SimulationOptions options;
  options.frames = 3;
  const auto one = Simulated(options, 1, "one");
  const auto four = Simulated(options, 4, "four");
  EXPECT_EQ(one.size(), 3u * 2 + 5 + 4);
  EXPECT_TRUE(one == four);
}

TEST(SimulateScan, SeedsDifferAndSensorsShareTheSceneAndMotion) {
  SimulationOptions options;
  options.frames = 1;
  options.sensor = "ideal";
  const auto first = Simulated(options, 0, "first");
  options.seed = 2;
  const auto second = Simulated(options, 0, "second");
  EXPECT_NE(first.at("truth/trajectory.txt"), second.at("truth/trajectory.txt"));
  EXPECT_NE(first.at("depth/1000.000000.png"), second.at("depth/1000.000000.png"));
  options.pose_source = "ptam";
  options.frames = 2;
  const auto other_poses = Simulated(options, 0, "other");
  EXPECT_EQ(other_poses.at("depth/1000.000000.png"), second.at("depth/1000.000000.png"));
  EXPECT_NE(other_poses.at("trajectory.txt"), other_poses.at("truth/trajectory.txt"));
}

TEST(SimulateScan, WritesTruthThatReadsBack) {
  const TemporaryFolder folder("curvefusion_simulate_test_truth");
  SimulationOptions options;
  options.object = "cage";
  options.sensor = "ideal";
  options.frames = 1;
  SimulateScan(options, folder.path(), NoProgress);
  const SkeletonGraph truth = ReadSkeleton(folder.path() / "truth" / "skeleton.json");
  EXPECT_EQ(truth.CycleRank(), 41);
  EXPECT_DOUBLE_EQ(truth.edge(truth.Edges()[0]).radii[0], 0.00225);
}

TEST(SimulateScan, InterruptedScanIsNoSequence) {
  const TemporaryFolder folder("curvefusion_simulate_test_interrupted");
  SimulationOptions options;
  options.sensor = "ideal";
  options.frames = 3;
  SimulateScan(options, folder.path(), NoProgress);
  ASSERT_TRUE(fs::exists(folder.path() / "associations.txt"));
  const Progress interrupt = [](std::string_view, int64_t done, int64_t) {
    if (done == 2) throw Error(ErrorKind::kInterrupted, "stop");
  };
  EXPECT_THROW(SimulateScan(options, folder.path(), interrupt), Error);
  EXPECT_FALSE(fs::exists(folder.path() / "associations.txt"));
  EXPECT_FALSE(fs::exists(folder.path() / "trajectory.txt"));
}

TEST(SimulateScan, RefusesWhatCannotBe) {
  SimulationOptions options;
  options.frames = 0;
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  options.frames = 1;
  options.readout_time = 0.04;
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  options.readout_time = 0;
  options.object = "teapot";
  EXPECT_THROW(SimulateScan(options, "unused", NoProgress), Error);
  EXPECT_FALSE(fs::exists("unused"));
}

}  // namespace
}  // namespace curvefusion
