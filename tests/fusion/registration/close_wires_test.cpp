#include "fusion/registration/close_wires.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "graph/contraction/ridge_skeleton.h"

namespace curvefusion {
namespace {

TEST(Magnification, BringsWiresAsFarApartAsIsResolved) {
  EXPECT_EQ(Magnification(0, 0.012), 1);
  EXPECT_EQ(Magnification(std::numeric_limits<double>::quiet_NaN(), 0.012), 1);
  EXPECT_EQ(Magnification(0.02, 0.012), 1);
  EXPECT_DOUBLE_EQ(Magnification(0.008, 0.012), 1.5);
  EXPECT_EQ(Magnification(0.001, 0.012), 2);
  EXPECT_EQ(Magnification(0.008, 0), 1);
}

TEST(ForCloseWires, DividesLengthsAlone) {
  const RidgeProjectionOptions options;
  const RidgeProjectionOptions close = ForCloseWires(options, 2);
  EXPECT_EQ(close.kernel_sigma, options.kernel_sigma / 2);
  EXPECT_EQ(close.contrast.flank_distance, options.contrast.flank_distance / 2);
  EXPECT_EQ(close.min_local_strength, options.min_local_strength);
}

// Six wires 8 mm apart, 150 mm long, measured to 1 mm.
ObservedPoints Row() {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.001);
  ObservedPoints points;
  for (int wire = 0; wire < 6; ++wire) {
    for (int i = 0; i < 600; ++i) {
      points.Add({0.008 * wire + noise(random), noise(random), 0.15 * i / 600}, Vec3::UnitY(), 1);
    }
  }
  return points;
}

TEST(ExtractRidgeSkeleton, PartsCloseWiresWhereMagnified) {
  const ObservedPoints row = Row();
  EXPECT_NE(ExtractRidgeSkeleton(row, RidgeOptions()).ComponentCount(), 6);
  const SkeletonGraph skeleton =
      ExtractRidgeSkeleton(row, RidgeOptions(), AffineTransform(Eigen::Scaling(1.6)));
  EXPECT_EQ(skeleton.ComponentCount(), 6);
  EXPECT_EQ(skeleton.edge_count(), 6);
  for (const EdgeId edge : skeleton.Edges()) {
    const Vec3 middle = skeleton.edge(edge).points[skeleton.edge(edge).points.size() / 2];
    // The mean of the hundred points around has an error of .1 mm.
    EXPECT_NEAR(std::remainder(middle.x(), 0.008), 0, 0.0005);
    EXPECT_NEAR(middle.y(), 0, 0.0005);
    EXPECT_NEAR(Length(skeleton.edge(edge).points), 0.15, 0.006);
  }
}

// The ridges of wires `spacing` apart and where they are after a motion of `drift` across.
RidgePoints Wires(int count, double spacing, double drift) {
  RidgePoints ridges;
  for (int wire = 0; wire < count; ++wire) {
    for (int i = 0; i < 50; ++i) {
      ridges.positions.push_back({spacing * wire + drift, 0.0005 * std::sin(i), 0.003 * i});
      ridges.directions.push_back(Vec3::UnitZ());
      ridges.strengths.push_back(1);
    }
  }
  return ridges;
}

class AlignedRows : public testing::TestWithParam<double> {};

TEST_P(AlignedRows, FindTheirOwnWires) {
  const RidgePoints row = Wires(6, 0.008, 0);
  const AlignmentTarget target({row.positions, row.directions});
  const RidgePoints drifted = Wires(6, 0.008, GetParam());
  const AlignmentResult result = AlignArrays(drifted, target, {}, 0.0075);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR((result.T_target_source * drifted.positions[0]).x(), 0, 0.0005);
}

INSTANTIATE_TEST_SUITE_P(Drifts, AlignedRows, testing::Values(0, 0.003, -0.005, 0.006, -0.007));

TEST(AlignArrays, OfNothingOrWithoutArraysIsAlignPoints) {
  const RidgePoints row = Wires(6, 0.008, 0);
  const AlignmentTarget target({row.positions, row.directions});
  EXPECT_FALSE(AlignArrays({}, target, {}, 0.008).converged);
  const RidgePoints drifted = Wires(6, 0.008, 0.001);
  EXPECT_EQ(AlignArrays(drifted, target, {}, 0).T_target_source.matrix(),
            AlignPoints(drifted.positions, target, {}).T_target_source.matrix());
}

TEST(ExtractRidgeSkeleton, OfNothingIsEmpty) {
  EXPECT_TRUE(
      ExtractRidgeSkeleton(ObservedPoints(), RidgeOptions(), AffineTransform(Eigen::Scaling(2.0)))
          .empty());
}

}  // namespace
}  // namespace curvefusion
