// Runs `curvefusion track` and `reconstruct` on scans without poses as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "capture/detect_format.h"
#include "fusion/tracking/tracked_poses.h"
#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Track : public CommandLine {
 protected:
  // A scan at 30 frames a second whose poses are kept beside it.
  void SimulateWithoutPoses(int frames) {
    ASSERT_EQ(Run("simulate cubeframe -o scan --sensor ideal --poses true --quiet --frames " +
                  std::to_string(frames))
                  .exit_code,
              0);
    fs::rename(folder_ / "scan/trajectory.txt", folder_ / "given.txt");
  }
};

TEST_F(Track, PosesOfAScanWithoutAnyAreWritten) {
  SimulateWithoutPoses(12);
  const Outcome outcome = Run("track scan -o tracked.txt --reference given.txt");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("tracked      12 of 12 frames"));
  EXPECT_THAT(outcome.output, HasSubstr("ATE"));
  const std::string text = Text("tracked.txt");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 12 + (text.front() == '#' ? 1 : 0));
}

TEST_F(Track, ReconstructDoesItByItselfAndSaysSo) {
  SimulateWithoutPoses(24);
  const Outcome check = Run("check scan");
  EXPECT_EQ(check.exit_code, 0) << check.output;
  EXPECT_THAT(check.output, HasSubstr("has no camera poses"));
  const Outcome outcome = Run("reconstruct scan -o result --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json report = nlohmann::json::parse(Text("result/report.json"));
  EXPECT_EQ(report["poses"]["from"], "tracking");
  EXPECT_EQ(report["poses"]["lost"].size(), 0u);
  EXPECT_TRUE(fs::exists(folder_ / "result/trajectory.txt"));
}

TEST_F(Track, GivenPosesAreUsedUnlessTrackingIsAskedFor) {
  ASSERT_EQ(SimulateCube(12).exit_code, 0);
  EXPECT_THAT(Run("reconstruct scan -o result --quiet").exit_code, testing::AnyOf(0, 4));
  EXPECT_EQ(nlohmann::json::parse(Text("result/report.json"))["poses"]["from"], "sequence");
  EXPECT_THAT(Run("reconstruct scan -o tracked --track --quiet").exit_code, testing::AnyOf(0, 4));
  EXPECT_EQ(nlohmann::json::parse(Text("tracked/report.json"))["poses"]["from"], "tracking");
}

TEST_F(Track, AReferenceOfAnotherClockIsBadInput) {
  SimulateWithoutPoses(4);
  std::ofstream(folder_ / "late.txt") << "5 0 0 0 0 0 0 1\n6 0 0 0 0 0 0 1\n";
  const Outcome outcome = Run("track scan -o tracked.txt --reference late.txt");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("late.txt: has poses for 0 of the 4 tracked frames"));
}

TEST_F(Track, PosesThatDepthDisagreesWithAreDoubted) {
  ASSERT_EQ(
      Run("simulate cubeframe -o scan --sensor ideal --poses true --quiet --frames 40").exit_code,
      0);
  Sequence tracked = ReadSequence(folder_ / "scan", PoseUse::kNeeded, DepthUse::kNeeded,
                                  [](const CheckFinding&) {});
  EXPECT_EQ(DoubtOfPoses(tracked), "");
  for (size_t i = 0; i < tracked.frames.size(); ++i) {
    Vec3 away = Vec3::Zero();
    away[static_cast<int>(i % 3)] = i % 2 == 0 ? 0.2 : -0.2;
    tracked.frames[i].T_world_camera.translation() += away;
  }
  EXPECT_THAT(DoubtOfPoses(tracked), HasSubstr("the camera was lost without notice"));
}

}  // namespace
}  // namespace curvefusion
