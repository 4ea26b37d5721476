#include "fusion/registration/pose_correction.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

RigidTransform SomePose(int i) {
  SmallMotion motion;
  motion << 0.1 * i, -0.2, 0.3, 0.2, 0.1 * i, -0.4;
  return RigidTransformOf(motion);
}

TEST(SmallMotionTest, ThereAndBack) {
  SmallMotion motion;
  motion << 0.001, -0.002, 0.003, 0.01, -0.02, 0.03;
  EXPECT_TRUE(SmallMotionOf(RigidTransformOf(motion)).isApprox(motion, 1e-9));  // rounding
  EXPECT_TRUE(RigidTransformOf(SmallMotion::Zero()).isApprox(RigidTransform::Identity()));
}

TEST(InterpolateCorrectionsTest, LinearBetweenAndConstantBeyond) {
  std::vector<RigidTransform> given;
  for (int i = 0; i < 8; ++i) given.push_back(SomePose(i));
  SmallMotion drift;
  drift << 0.001, 0, -0.002, 0.002, 0, 0.001;
  // The correction of frame 1 is the drift, of frame 5 thrice as much.
  const std::vector<RigidTransform> corrected = {given[1] * RigidTransformOf(drift),
                                                 given[5] * RigidTransformOf(3 * drift)};
  const auto poses = InterpolateCorrections(given, {1, 5}, corrected);
  ASSERT_EQ(poses.size(), 8u);
  const std::vector<double> expected = {1, 1, 1.5, 2, 2.5, 3, 3, 3};
  for (size_t i = 0; i < poses.size(); ++i) {
    const RigidTransform T = given[i] * RigidTransformOf(expected[i] * drift);
    EXPECT_TRUE(poses[i].isApprox(T, 1e-9)) << i;  // rounding
  }
}

TEST(InterpolateCorrectionsTest, NoFramesNoCorrection) {
  const std::vector<RigidTransform> given = {SomePose(1)};
  EXPECT_TRUE(InterpolateCorrections(given, {}, {})[0].isApprox(given[0]));
}

}  // namespace
}  // namespace curvefusion
