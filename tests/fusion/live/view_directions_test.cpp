#include "fusion/live/view_directions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernel/angle.h"

namespace curvefusion {
namespace {

// Directions are known to the width of a bin: 18 degrees in the middle of a cube's face, more
// towards its corners.
constexpr double kBin = 25 * kDegree;

// Across the z axis.
Vec3 At(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

double AngleOf(const Vec3& direction) { return std::atan2(direction.y(), direction.x()); }

TEST(ViewDirections, EveryDirectionIsCountedInItsOwnBin) {
  for (int bin = 0; bin < ViewDirections::kBins; ++bin) {
    ViewDirections views;
    views.Add(3 * ViewDirections::Direction(bin));
    for (int other = 0; other < ViewDirections::kBins; ++other) {
      EXPECT_EQ(views.count(other), other == bin ? 1 : 0);
    }
  }
}

TEST(ViewDirections, SumsStopAtTheMostThatCanBeCounted) {
  ViewDirections views;
  views.Add(Vec3::UnitX());
  for (int i = 0; i < 17; ++i) views += ViewDirections(views);  // 2^17 frames
  const ViewDirections once = views;
  views += once;
  int most = 0;
  for (int bin = 0; bin < ViewDirections::kBins; ++bin) most = std::max(most, views.count(bin));
  EXPECT_EQ(most, 65535);
}

TEST(ViewDirections, TheArcIsWhatViewsSpan) {
  for (const double span : {60 * kDegree, 120 * kDegree, 200 * kDegree}) {
    for (const double begin : {0.0, 170 * kDegree}) {  // over the seam of angles, too
      ViewDirections views;
      for (int i = 0; i <= 200; ++i) views.Add(At(begin + span * i / 200));
      EXPECT_NEAR(ArcAround(views, Vec3::UnitZ()).spread, span, kBin);
    }
  }
}

TEST(ViewDirections, MoreIsSeenBesideTheSideThatFewerFramesSaw) {
  ViewDirections views;
  for (int i = 0; i < 40; ++i) views.Add(At(0));
  for (int i = 0; i < 4; ++i) views.Add(At(60 * kDegree));
  const ViewArc arc = ArcAround(views, Vec3::UnitZ());
  EXPECT_NEAR(arc.least_seen.norm(), 1, 1e-12);
  EXPECT_NEAR(arc.least_seen.z(), 0, 1e-12);
  EXPECT_NEAR(AngleOf(arc.least_seen), 105 * kDegree, kBin);
}

TEST(ViewDirections, ViewsAlongTheCurveAndGlimpsesDoNotCount) {
  ViewDirections views;
  for (int i = 0; i < 9; ++i) views.Add(Vec3::UnitZ());
  views.Add(Vec3::UnitX());  // once
  const ViewArc arc = ArcAround(views, Vec3::UnitZ());
  EXPECT_EQ(arc.spread, 0);
  EXPECT_TRUE(arc.least_seen.isZero());
}

TEST(ViewDirections, OneDirectionAloneSpansNothing) {
  ViewDirections views;
  for (int i = 0; i < 9; ++i) views.Add(Vec3::UnitX());
  EXPECT_NEAR(ArcAround(views, Vec3::UnitZ()).spread, 0, 1e-9);
  EXPECT_FALSE(ArcAround(views, Vec3::UnitZ()).least_seen.isZero());
}

}  // namespace
}  // namespace curvefusion
