#include "graph/contraction/suggested_radius.h"

#include <gtest/gtest.h>

#include <limits>

#include "kernel/error.h"
#include "tests/graph/tube_points.h"

namespace curvefusion {
namespace {

TEST(SuggestedRadius, IsTwoToFiveTimesTheDiameterOfAWire) {
  // The paper has 15 mm for wires of 2 to 10 mm.
  const double radius = SuggestedRadius(HelixTube());
  EXPECT_GT(radius, 2 * 5e-3);
  EXPECT_LT(radius, 5 * 5e-3);
}

TEST(SuggestedRadius, FollowsTheUnitOfTheCloud) {
  ObservedPoints points = HelixTube();
  const double metres = SuggestedRadius(points);
  for (Vec3& p : points.positions) p *= 1024;  // a power of two: the same bits but the exponent
  EXPECT_DOUBLE_EQ(SuggestedRadius(points), 1024 * metres);
}

TEST(SuggestedRadius, StopsShortOfTheNextWire) {
  ObservedPoints points;
  for (int i = 0; i < 6; ++i)
    AddTube({Vec3(0, 0.02 * i, 0), Vec3(0.2, 0.02 * i, 0)}, 2.5e-3, 2000, 0.5e-3, points);
  EXPECT_LT(SuggestedRadius(points), 0.02);
}

TEST(SuggestedRadius, ABallHasTheSpacingOfItsPoints) {
  ObservedPoints points;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  while (points.size() < 4096) {
    const Vec3 p(coordinate(random), coordinate(random), coordinate(random));
    if (p.norm() <= 1) points.Add(p, Vec3::Zero(), 1);
  }
  // 2 diagonals over the cube root of 4096. A hundredth of a ball lies farther than .882 radii to
  // one side.
  EXPECT_NEAR(SuggestedRadius(points), 2 * 2 * 0.882 * std::sqrt(3.0) / 16, 0.01);
}

TEST(SuggestedRadius, OutliersDoNotCount) {
  ObservedPoints points = HelixTube();
  const double radius = SuggestedRadius(points);
  points.Add(Vec3(1e6, 0, 0), Vec3::Zero(), 1);
  EXPECT_NEAR(SuggestedRadius(points), radius, 0.2 * radius);
}

TEST(SuggestedRadius, NoExtentNoRadius) {
  ObservedPoints points;
  EXPECT_EQ(SuggestedRadius(points), 0);
  for (int i = 0; i < 40; ++i) points.Add(Vec3(1, 2, 3), Vec3::Zero(), 1);
  EXPECT_EQ(SuggestedRadius(points), 0);
  // More duplicates than the least number of neighbours, and one point elsewhere.
  points.Add(Vec3(2, 2, 3), Vec3::Zero(), 1);
  EXPECT_GT(SuggestedRadius(points), 0);
}

TEST(SuggestedRadius, RejectsPointsThatAreNotFinite) {
  ObservedPoints points = HelixTube();
  points.positions[0].x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(SuggestedRadius(points), Error);
}

}  // namespace
}  // namespace curvefusion
