#include "fusion/paper/skeleton_alignment.h"

#include <gtest/gtest.h>

#include "kernel/parallel.h"
#include "kernel/rigid_motion.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

const RigidTransform kMotion = RigidMotion({0.01, 0.005, 0.01}, {0.003, -0.002, 0.004});

TEST(AlignSkeletons, FindsTheMotionOfALattice) {
  const SkeletonGraph target = Lattice(4, 5, 0.05);
  const SkeletonGraph source = Transformed(target, kMotion.inverse());
  // Pairs of samples slide slowly along lines; they rest where both samplings fit, within a step.
  EXPECT_LT(Difference(AlignSkeletons(source, target, {}), kMotion, source), 2e-3);
}

TEST(AlignSkeletons, APartFindsItsPlaceOnTheWhole) {
  const SkeletonGraph target = Lattice(4, 8, 0.05);
  const SkeletonGraph source = Transformed(Lattice(4, 3, 0.05), kMotion.inverse());
  EXPECT_LT(Difference(AlignSkeletons(source, target, {}), kMotion, source), 2e-3);
}

TEST(AlignSkeletons, WhatIsTooFarPairsWithNothing) {
  const SkeletonGraph target = Lattice(3, 3, 0.05);
  const SkeletonGraph far = Transformed(target, RigidMotion(Vec3::Zero(), {0, 0, 1}));
  const RigidTransform identity = RigidTransform::Identity();
  EXPECT_EQ(AlignSkeletons(far, target, {}).matrix(), identity.matrix());
  EXPECT_EQ(AlignSkeletons({}, target, {}).matrix(), identity.matrix());
}

TEST(AlignSkeletons, TheNumberOfThreadsDoesNotMatter) {
  const SkeletonGraph target = Lattice(4, 5, 0.05);
  const SkeletonGraph source = Transformed(target, kMotion.inverse());
  const auto align = [&](int threads) {
    const ThreadLimit limit(threads);
    return AlignSkeletons(source, target, {}).matrix().eval();
  };
  EXPECT_EQ(align(1), align(2));
}

}  // namespace
}  // namespace curvefusion
