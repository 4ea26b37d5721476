#include "capture/trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kernel/error.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class TrajectoryTest : public testing::Test {
 protected:
  Trajectory Read(const std::string& text) {
    WriteText(folder_.path() / "trajectory.txt", text);
    return ReadTumTrajectory(folder_.path() / "trajectory.txt", [this](const CheckFinding& found) {
      messages_.push_back(found.message);
    });
  }

  TemporaryFolder folder_;
  std::vector<std::string> messages_;
};

// The quaternion (0, 0, s, s) with s = sqrt(1/2) turns x to y.
TEST_F(TrajectoryTest, ReadsTranslationAndQuaternion) {
  const Trajectory trajectory =
      Read("# comment\r\n\n1.5 1 2 3 0 0 0.70710678 0.70710678 # end\r\n2.5,1,2,3,0,0,0,1\n");
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].timestamp, 1.5);
  // 8 digits in the file
  EXPECT_TRUE((trajectory[0].T_world_camera * Vec3(1, 0, 0)).isApprox(Vec3(1, 3, 3), 1e-7));
  EXPECT_THAT(messages_, ElementsAre());
}

TEST_F(TrajectoryTest, ShortQuaternionsAreMadeUnit) {
  const Trajectory trajectory = Read("1 0 0 0 0 0 0.707 0.707\n");
  // exact up to rounding: the digits that are missing do not leave a scaled rotation
  EXPECT_NEAR(trajectory.at(0).T_world_camera.linear().determinant(), 1, 1e-12);
}

TEST_F(TrajectoryTest, SortsAndWarns) {
  const Trajectory trajectory = Read("2 2 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n1 9 0 0 0 0 0 1\n");
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].T_world_camera.translation().x(), 1);
  EXPECT_EQ(trajectory[1].T_world_camera.translation().x(), 2);
  EXPECT_THAT(messages_, ElementsAre(HasSubstr("not in order (first at 1.000000)"),
                                     HasSubstr("1.000000 stands there more than once")));
}

TEST_F(TrajectoryTest, ReportsLinesThatAreNoPose) {
  const Trajectory trajectory =
      Read("1 0 0 0 0 0 1\n2 0 0 0 0 0 zero 1\n3 nan 0 0 0 0 0 1\n4 0 0 0 1 1 1 1\n");
  EXPECT_TRUE(trajectory.empty());
  EXPECT_THAT(
      messages_,
      ElementsAre(HasSubstr("trajectory.txt:1: 8 numbers are needed, the line has 7"),
                  HasSubstr("trajectory.txt:2: 'zero' is not a number"),
                  HasSubstr("trajectory.txt:3: the pose at 3 holds nan"),
                  HasSubstr("trajectory.txt:4: the quaternion of the pose at 4 has length 2")));
}

TEST_F(TrajectoryTest, ReadsWhatWasWritten) {
  Trajectory written(2);
  written[0].timestamp = 1.5;
  written[1].timestamp = 1000.033333;
  written[1].T_world_camera.linear() =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  written[1].T_world_camera.translation() = Vec3(-0.1, 20, 3e-5);
  WriteTumTrajectory(folder_.path() / "trajectory.txt", written);
  const Trajectory read = ReadTumTrajectory(folder_.path() / "trajectory.txt", FailOnFinding());
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].timestamp, 1.5);
  EXPECT_EQ(read[1].timestamp, 1000.033333);
  // 9 digits in the file
  EXPECT_TRUE(read[1].T_world_camera.isApprox(written[1].T_world_camera, 1e-8));
}

TEST_F(TrajectoryTest, AMissingFileThrows) {
  EXPECT_THROW(ReadTumTrajectory(folder_.path() / "none.txt", FailOnFinding()), Error);
}

TEST(NearestPoseTest, TakesTheNearestWithinTwentyMilliseconds) {
  const Trajectory trajectory = {{1.0, {}}, {1.03, {}}, {2.0, {}}};
  EXPECT_EQ(NearestPose(trajectory, 1.014), &trajectory[0]);
  EXPECT_EQ(NearestPose(trajectory, 1.016), &trajectory[1]);
  EXPECT_EQ(NearestPose(trajectory, 0.981), &trajectory[0]);
  EXPECT_EQ(NearestPose(trajectory, 0.979), nullptr);
  EXPECT_EQ(NearestPose(trajectory, 1.5), nullptr);
  EXPECT_EQ(NearestPose(trajectory, 2.019), &trajectory[2]);
  EXPECT_EQ(NearestPose(trajectory, 2.021), nullptr);
  EXPECT_EQ(NearestPose({}, 1), nullptr);
}

TEST(RigidFromMatrixTest, RoundedRotationsAreMadeOrthonormal) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<2, 2>() << 0.8661, -0.5, 0.5, 0.8661;  // cos 30 = .866025, off by 7.5e-5
  matrix(0, 3) = 7;
  const auto pose = RigidFromMatrix(matrix, "pose", FailOnFinding());
  ASSERT_TRUE(pose);
  EXPECT_TRUE((pose->linear().transpose() * pose->linear()).isIdentity(1e-12));
  EXPECT_NEAR(std::atan2(pose->linear()(1, 0), pose->linear()(0, 0)), M_PI / 6, 1e-4);
  EXPECT_EQ(pose->translation(), Vec3(7, 0, 0));
}

TEST(RigidFromMatrixTest, ScaledMirroredAndNanMatricesAreReported) {
  std::vector<std::string> messages;
  const FindingHandler collect = [&messages](const CheckFinding& finding) {
    messages.push_back(finding.message);
  };
  Eigen::Matrix4d scaled = Eigen::Matrix4d::Identity();
  scaled(1, 1) = 1.001;  // R'R - I = 0.002
  Eigen::Matrix4d mirrored = Eigen::Matrix4d::Identity();
  mirrored(2, 2) = -1;
  Eigen::Matrix4d broken = Eigen::Matrix4d::Identity();
  broken(0, 3) = NAN;
  EXPECT_FALSE(RigidFromMatrix(scaled, "a", collect));
  EXPECT_FALSE(RigidFromMatrix(mirrored, "b", collect));
  EXPECT_FALSE(RigidFromMatrix(broken, "c", collect));
  // Products overflow to infinity, and their differences to NaN.
  Eigen::Matrix4d huge = Eigen::Matrix4d::Identity();
  huge.topLeftCorner<2, 2>() << 1e200, 1e200, 1e200, -1e200;
  EXPECT_FALSE(RigidFromMatrix(huge, "d", [](const CheckFinding&) {}));
  EXPECT_THAT(messages, ElementsAre(HasSubstr("a: the pose is not rigid: |R'R - I| = 0.002"),
                                    HasSubstr("det R = -1"), HasSubstr("c: the pose holds NaN")));
}

}  // namespace
}  // namespace curvefusion
