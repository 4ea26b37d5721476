#include "apps/run_observer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "kernel/cloud_io.h"
#include "kernel/error.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class RunObserverTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::temp_directory_path() / ("curvefusion_run_observer_test_" + std::to_string(getpid()));
  std::ostringstream stream_;
  ProgressPrinter printer_{stream_, ProgressPrinter::Style::kLines, [] { return 0.; }};
};

TEST_F(RunObserverTest, SavesWhatItHearsUnderItsName) {
  RunObserver observer(printer_, {folder_ / "stages", {}});
  ObservedPoints points;
  points.Add({1, 2, 3}, Vec3::UnitZ(), 4);
  observer.OnPoints("bundle_000_difference_set", points);
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0, 0, 1}});
  observer.OnGraph("bundle_000_skeleton", graph);
  EXPECT_EQ(ReadCloud(folder_ / "stages/bundle_000_difference_set.ply").positions,
            points.positions);
  EXPECT_TRUE(fs::exists(folder_ / "stages/bundle_000_skeleton.ply"));
}

TEST_F(RunObserverTest, SavesNothingUnlessAsked) {
  RunObserver observer(printer_, {});
  observer.OnPoints("points", {});
  observer.OnGraph("graph", {});
  observer.OnVolume(TsdfVolume(TsdfOptions()));
  EXPECT_FALSE(fs::exists(folder_));
  EXPECT_FALSE(fs::exists("points.ply"));
}

TEST_F(RunObserverTest, SavesTheVolumeWhenAsked) {
  RunObserver observer(printer_, {{}, folder_ / "volume.ply"});
  TsdfVolume volume{TsdfOptions()};
  // A wall 1 m in front of the camera.
  volume.Integrate(DepthImage(64, 48, 1), {64, 48, 60, 60, 31.5, 23.5}, RigidTransform::Identity());
  observer.OnVolume(volume);
  EXPECT_GT(fs::file_size(folder_ / "volume.ply"), 1000u);
}

TEST_F(RunObserverTest, AStageFolderThatCannotBeMadeIsAnErrorAtOnce) {
  std::ofstream(folder_) << "a file";
  EXPECT_THROW(RunObserver(printer_, {folder_ / "stages", {}}), Error);
}

}  // namespace
}  // namespace curvefusion
