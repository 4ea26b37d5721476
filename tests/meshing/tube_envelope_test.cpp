#include "meshing/tube_envelope.h"

#include <gtest/gtest.h>

#include <numbers>

#include "meshing/tube_volume.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;

TubeAxis AxisOf(const Polyline& points) {
  return {points, std::vector<double>(points.size(), kRadius)};
}

// A straight wire whose points lie to and fro, .15 radii to either side.
Polyline Zigzag() {
  Polyline points;
  for (int i = 0; i <= 80; ++i) {
    points.emplace_back(0.5 * kRadius * i, 0.15 * kRadius * (i % 2 == 0 ? 1 : -1), 0);
  }
  return points;
}

TEST(FitToEnvelope, StraightAxisStaysAsItIs) {
  const TubeAxis axis = AxisOf({{0, 0, 0}, {0.01, 0, 0}, {0.03, 0, 0}});
  const TubeAxis fitted = FitToEnvelope(axis);
  EXPECT_EQ(fitted.points, axis.points);
  EXPECT_EQ(fitted.radii, axis.radii);
}

TEST(FitToEnvelope, ZigzagBecomesAStraightThickerTube) {
  const TubeAxis fitted = FitToEnvelope(AxisOf(Zigzag()));
  const double length = 40 * kRadius;
  for (size_t i = 0; i < fitted.points.size(); ++i) {
    const double x = fitted.points[i].x();
    if (x < 2 * kRadius || x > length - 2 * kRadius) continue;  // both ends stay as they are
    // A third of the zigzag is left at most, and the tube is thicker by less than the zigzag.
    EXPECT_LT(std::abs(fitted.points[i].y()), 0.05 * kRadius);
    EXPECT_GT(fitted.radii[i], kRadius);
    EXPECT_LT(fitted.radii[i], 1.15 * kRadius);
  }
}

TEST(FitToEnvelope, KeepsTheVolumeOfTheBalls) {
  SkeletonGraph rough;
  AddCurve(rough, Zigzag(), kRadius);
  const TubeAxis fitted = FitToEnvelope(AxisOf(Zigzag()));
  double volume = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;  // both end caps
  for (size_t i = 0; i + 1 < fitted.points.size(); ++i) {
    const double radius = (fitted.radii[i] + fitted.radii[i + 1]) / 2;
    volume += std::numbers::pi * radius * radius * (fitted.points[i + 1] - fitted.points[i]).norm();
  }
  // Sampling knows it within .15 %; the stretches next to the ends, a tenth of the length, are
  // longer than the tube by the zigzag's 17 %.
  EXPECT_NEAR(volume / VolumeOfTubes(rough, 200000).volume, 1, 0.02);
}

}  // namespace
}  // namespace curvefusion
