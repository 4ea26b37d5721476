#include "experiments/metrics/trajectory_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvefusion {
namespace {

// A quarter of a helix that looks along its way.
std::vector<RigidTransform> Helix() {
  std::vector<RigidTransform> poses;
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.03 * i;
    RigidTransform pose(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
    pose.translation() = Vec3(std::cos(angle), std::sin(angle), 0.1 * angle);
    poses.push_back(pose);
  }
  return poses;
}

TEST(TrajectoryMetrics, OneMotionOfAllIsNoError) {
  const std::vector<RigidTransform> truth = Helix();
  std::vector<RigidTransform> moved = truth;
  const RigidTransform motion =
      Eigen::Translation3d(0.3, -0.1, 0.2) * Eigen::AngleAxisd(0.4, Vec3(1, 2, 2) / 3);
  for (RigidTransform& pose : moved) pose = motion * pose;
  EXPECT_LT(AbsoluteTrajectoryError(moved, truth), 1e-12);
  EXPECT_LT(RelativePoseErrors(moved, truth, 30).translation, 1e-12);
  EXPECT_LT(RelativePoseErrors(moved, truth, 30).rotation, 1e-6);  // acos near 1
}

// Every camera moves 1 mm more to its right per frame.
TEST(TrajectoryMetrics, ConstantDriftIsCountedPerFrame) {
  const std::vector<RigidTransform> truth(60, RigidTransform::Identity());
  std::vector<RigidTransform> drifted;
  for (int i = 0; i < 60; ++i) drifted.emplace_back(Eigen::Translation3d(0.001 * i, 0, 0));
  EXPECT_NEAR(RelativePoseErrors(drifted, truth, 30).translation, 0.030, 1e-12);
  EXPECT_EQ(RelativePoseErrors(drifted, truth, 30).rotation, 0);
}

// Of cameras 3 and -3 mm off in turns, alignment can explain next to nothing.
TEST(TrajectoryMetrics, JitterRemainsAfterAlignment) {
  const std::vector<RigidTransform> truth = Helix();
  std::vector<RigidTransform> estimate = truth;
  for (size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].translation().z() += i % 2 == 0 ? 0.003 : -0.003;
  }
  EXPECT_NEAR(AbsoluteTrajectoryError(estimate, truth), 0.003, 3e-5);
}

}  // namespace
}  // namespace curvefusion
