#include "kernel/rigid_motion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace curvefusion {
namespace {

TEST(RigidMotion, TurnsAboutTheOriginAndThenMoves) {
  const RigidTransform motion = RigidMotion({0, 0, std::numbers::pi / 2}, {1, 2, 3});
  // Rounding of a sine and a cosine.
  EXPECT_LT((motion * Vec3(1, 0, 0) - Vec3(1, 3, 3)).norm(), 1e-15);
}

TEST(RigidMotion, AboutACentreMovesTheCentreByTheTranslation) {
  const Vec3 center(1, -2, 0.5);
  const RigidTransform motion = RigidMotionAbout(center, {0, 0, std::numbers::pi / 2}, {3, 0, 1});
  // Rounding of a sine and a cosine.
  EXPECT_LT((motion * center - Vec3(4, -2, 1.5)).norm(), 1e-15);
  EXPECT_LT((motion * (center + Vec3::UnitX()) - Vec3(4, -1, 1.5)).norm(), 1e-15);
}

TEST(RigidMotion, WithoutRotationIsAnExactTranslation) {
  EXPECT_EQ(RigidMotion(Vec3::Zero(), {1, 2, 3}).matrix(),
            RigidTransform(Eigen::Translation3d(1, 2, 3)).matrix());
  EXPECT_EQ(RotationVector(RigidTransform::Identity()), Vec3::Zero());
}

TEST(RigidMotion, GivesItsRotationVectorBack) {
  for (const Vec3& rotation : {Vec3(0.1, -0.2, 0.3), Vec3(-2, 1, 0.5), Vec3(1e-6, 0, 0)}) {
    // The angle is computed from matrix entries near 1, which rounding changes by 1e-16.
    EXPECT_LT((RotationVector(RigidMotion(rotation, Vec3::Zero())) - rotation).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace curvefusion
