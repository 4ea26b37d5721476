#include "fusion/registration/trajectory_anchor.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "fusion/registration/pose_correction.h"

namespace curvefusion {
namespace {

RigidTransform Pose(int i) {
  SmallMotion motion;
  motion << 0.005 * i, -0.2, 0.3, 0.2, 0.01 * i, -0.4;
  return RigidTransformOf(motion);
}

RigidTransform Displacement() {
  SmallMotion motion;
  motion << 0.002, -0.003, 0.001, 0.004, -0.001, 0.002;
  return RigidTransformOf(motion);
}

std::vector<int> FramesFromZero(int count) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

SmallMotion Noise(std::mt19937& random, double translation, double rotation) {
  std::normal_distribution<double> normal;
  SmallMotion motion;
  for (int i = 0; i < 6; ++i) motion[i] = (i < 3 ? translation : rotation) * normal(random);
  return motion;
}

// How well a corrected pose is known.
SmallMotion Sigmas() {
  SmallMotion sigmas;
  sigmas << Vec3::Constant(0.0005), Vec3::Constant(0.0005);
  return sigmas;
}

TEST(AnchorToGivenPosesTest, TakesBackADisplacementOfTheWorld) {
  std::vector<RigidTransform> given, corrected;
  for (int i = 0; i < 100; ++i) given.push_back(Pose(i));
  std::vector<int> indices;
  for (int i = 0; i < 100; i += 3) {
    indices.push_back(i);
    corrected.push_back(Displacement() * given[i]);
  }
  const std::vector<SmallMotion> sigmas(corrected.size(), Sigmas());
  const RigidTransform T = AnchorToGivenPoses(given, indices, corrected, sigmas);
  EXPECT_TRUE((T * Displacement()).isApprox(RigidTransform::Identity(), 1e-9));  // rounding
}

TEST(AnchorToGivenPosesTest, OneFrameIsHeld) {
  const RigidTransform T =
      AnchorToGivenPoses({Pose(0)}, {0}, {Displacement() * Pose(0)}, {Sigmas()});
  EXPECT_TRUE((T * Displacement()).isApprox(RigidTransform::Identity(), 1e-9));  // rounding
}

TEST(AnchorToGivenPosesTest, NoFramesNoMotion) {
  EXPECT_TRUE(AnchorToGivenPoses({Pose(0)}, {}, {}, {}).isApprox(RigidTransform::Identity()));
}

// Given poses that drift, and corrected ones that err, as the model says: the estimate beats both
// the first frame alone and the mean over all frames.
TEST(AnchorToGivenPosesTest, BeatsTheFirstFrameAndTheMean) {
  std::mt19937 random(7);
  double anchored = 0, first = 0, mean = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<RigidTransform> given, corrected;
    SmallMotion drift = SmallMotion::Zero(), sum = SmallMotion::Zero();
    for (int i = 0; i < 60; ++i) {
      const SmallMotion error = Noise(random, 0.0005, 0.0005);
      corrected.push_back(Pose(i) * RigidTransformOf(error));
      given.push_back(Pose(i) * RigidTransformOf(drift));
      sum += (error - drift) / 60;
      drift += Noise(random, 0.00033, 0.00036);  // ORB-SLAM2 at 30 Hz
      if (i == 0) first += error.head<3>().squaredNorm();
    }
    const RigidTransform T =
        AnchorToGivenPoses(given, FramesFromZero(60), corrected, std::vector(60, Sigmas()));
    anchored += (T * Pose(0).translation() - Pose(0).translation()).squaredNorm();
    mean += sum.head<3>().squaredNorm();
  }
  // The best that the model allows is .6 of the variance of a single frame's error.
  EXPECT_LT(anchored, 0.8 * first);
  EXPECT_LT(anchored, 0.3 * mean);
}

// A frame whose pose is known badly says little.
TEST(AnchorToGivenPosesTest, WeighsFramesByHowWellTheyAreKnown) {
  const SmallMotion badly = 100 * Sigmas();
  const RigidTransform T = AnchorToGivenPoses(
      {Pose(0), Pose(1)}, {0, 1}, {Displacement() * Pose(0), Pose(1)}, {badly, Sigmas()});
  EXPECT_LT((T.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-3);
}

}  // namespace
}  // namespace curvefusion
