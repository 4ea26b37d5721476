#include "fusion/strips/strip_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvefusion {
namespace {

constexpr PinholeCamera kCamera = {640, 480, 580, 580, 319.5, 239.5};

std::vector<ProjectedSample> ProjectAll(const SkeletonGraph& skeleton, double step) {
  return ProjectSamples(SampleStrips(skeleton, step), SampleStrips(skeleton, 0.001), kCamera,
                        RigidTransform::Identity(), 8);
}

TEST(SampleStripsTest, SamplesLieInTheMiddleOfEqualSteps) {
  SkeletonGraph skeleton;
  const EdgeId edge = skeleton.AddPolyline({{0, 0, 1}, {0.05, 0, 1}, {0.1, 0, 1}});
  const auto samples = SampleStrips(skeleton, 0.026);
  ASSERT_EQ(samples.size(), 4u);  // 0.1 / 0.026 rounds to 4 steps of 0.025
  EXPECT_EQ(samples[1].edge, edge);
  EXPECT_NEAR(samples[1].arc_length, 0.0375, 1e-15);
  EXPECT_TRUE(samples[1].position.isApprox(Vec3(0.0375, 0, 1), 1e-12));
  EXPECT_TRUE(samples[1].tangent.isApprox(Vec3(1, 0, 0), 1e-12));
}

TEST(SampleStripsTest, AnEmptySkeletonHasNone) { EXPECT_TRUE(SampleStrips({}, 0.01).empty()); }

// Oracle: the extent, across the projected axis, of the projections of a cylinder's surface points.
TEST(ProjectSamplesTest, MetresPerPixelIsThatOfACylindersSilhouette) {
  const double radius = 0.004;
  const Vec3 middle(0.22, -0.15, 0.7);  // far from the optical axis, where z / f is off by 4 %
  const Vec3 axis = Vec3(0.3, 1, 0.5).normalized();
  SkeletonGraph skeleton;
  skeleton.AddPolyline({middle - 0.01 * axis, middle + 0.01 * axis});
  const auto projected = ProjectAll(skeleton, 0.02);
  ASSERT_EQ(projected.size(), 1u);
  const Vec3 side = axis.unitOrthogonal();
  const Vec3 other = axis.cross(side);
  double least = 1e9;
  double greatest = -1e9;
  for (int i = 0; i < 3600; ++i) {
    const double angle = 2 * M_PI * i / 3600;
    // Silhouette lines are straight: a surface point slid along the axis stays on its line, so only
    // the distance across the axis' image counts near the sample.
    const Vec3 p = middle + radius * (std::cos(angle) * side + std::sin(angle) * other);
    const double across = (kCamera.Project(p) - projected[0].pixel).dot(projected[0].normal);
    least = std::min(least, across);
    greatest = std::max(greatest, across);
  }
  // First order in radius over distance: 0.5 %.
  EXPECT_NEAR((greatest - least) * projected[0].metres_per_px, 2 * radius, 0.005 * 2 * radius);
}

TEST(ProjectSamplesTest, HiddenOrEndOnSamplesAreLeftOut) {
  SkeletonGraph behind;
  behind.AddPolyline({{0, 0, -1}, {0.1, 0, -1}});
  EXPECT_TRUE(ProjectAll(behind, 0.01).empty());
  SkeletonGraph outside;
  outside.AddPolyline({{2, 0, 1}, {2.1, 0, 1}});
  EXPECT_TRUE(ProjectAll(outside, 0.01).empty());
  SkeletonGraph end_on;
  end_on.AddPolyline({{0.01, 0, 0.6}, {0.01, 0, 0.7}});
  EXPECT_TRUE(ProjectAll(end_on, 0.01).empty());
}

// The clearances against the normal and along it of the middle of a curve along x.
std::array<double, 2> SideClearances(const Polyline& other) {
  SkeletonGraph skeleton;
  const EdgeId edge = skeleton.AddPolyline({{-0.1, 0, 0.58}, {0.1, 0, 0.58}});
  skeleton.AddPolyline(other);
  const auto projected = ProjectSamples(SampleStrips(skeleton, 0.2), SampleStrips(skeleton, 0.001),
                                        kCamera, RigidTransform::Identity(), 8, {.by_side = true});
  EXPECT_EQ(projected.front().edge, edge);
  EXPECT_NEAR(projected.front().normal.y(), 1, 1e-9);
  return projected.front().side_clearance_px;
}

// At 0.58 m one millimetre is one pixel.
TEST(ProjectSamplesTest, ClearancesOfTheTwoSides) {
  const double far = 16;
  const auto branch = SideClearances({{0.002, 0, 0.58}, {0.002, 0.05, 0.58}});
  EXPECT_EQ(branch[0], far);
  EXPECT_LT(branch[1], 4);
  const auto farther_along = SideClearances({{0.008, 0, 0.58}, {0.008, 0.05, 0.58}});
  EXPECT_EQ(farther_along[0], far);
  EXPECT_EQ(farther_along[1], far);
  const auto parallel = SideClearances({{-0.05, -0.01, 0.58}, {0.05, -0.01, 0.58}});
  EXPECT_NEAR(parallel[0], 10, 0.6);
  EXPECT_NEAR(parallel[1], 10, 0.6);
  const auto behind = SideClearances({{-0.05, 0, 0.7}, {0.05, 0, 0.7}});
  EXPECT_LT(behind[0], 1);
  EXPECT_LT(behind[1], 1);
  // A double of the curve, as where two edges of it meet at a small angle.
  const auto in_line = SideClearances({{-0.05, 0.001, 0.58}, {0.05, -0.001, 0.58}});
  EXPECT_EQ(in_line[0], far);
  EXPECT_EQ(in_line[1], far);
}

// At 0.58 m one millimetre is one pixel.
TEST(ProjectSamplesTest, ClearanceIsTheDistanceToOtherCurves) {
  SkeletonGraph skeleton;
  const EdgeId edge = skeleton.AddPolyline({{-0.1, 0, 0.58}, {0.1, 0, 0.58}});
  skeleton.AddPolyline({{-0.1, 0.012, 0.58}, {0, 0.012, 0.58}});
  for (const ProjectedSample& sample : ProjectAll(skeleton, 0.01)) {
    if (sample.edge != edge) continue;
    const double beyond_px = std::max(0.0, (sample.arc_length - 0.1) * 1000);
    // neighbours stand 1 px apart
    EXPECT_NEAR(sample.clearance_px, std::min(40.0, std::hypot(12, beyond_px)), 0.6);
  }
}

TEST(ProjectSamplesTest, AnEdgeThatTurnsBackIsAnotherCurve) {
  SkeletonGraph skeleton;
  skeleton.AddPolyline({{-0.1, 0, 0.58}, {0.1, 0, 0.58}, {0.1, 0.015, 0.58}, {-0.1, 0.015, 0.58}});
  int far_from_turn = 0;
  for (const ProjectedSample& sample : ProjectAll(skeleton, 0.01)) {
    if (sample.arc_length > 0.12) continue;
    EXPECT_NEAR(sample.clearance_px, 15, 0.1);
    ++far_from_turn;
  }
  EXPECT_EQ(far_from_turn, 12);
}

}  // namespace
}  // namespace curvefusion
