#include "meshing/grazing_ways.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;

TubeAxis AxisOf(const Polyline& points) {
  return {points, std::vector<double>(points.size(), kRadius)};
}

// A straight line in steps of a radius.
TubeAxis Line(const Vec3& from, const Vec3& to) { return AxisOf(Resample({from, to}, kRadius)); }

int Count(const std::vector<Vec3>& ways) {
  int count = 0;
  for (const Vec3& way : ways) count += !way.isZero();
  return count;
}

TEST(FindGrazingWays, TubesThatCrossAtTouchingDistance) {
  for (const double diameters : {0.97, 1.0, 1.03}) {
    const double height = 2 * kRadius * diameters;
    const auto ways = FindGrazingWays(
        {Line({-0.03, 0, 0}, {0.03, 0, 0}), Line({0, -0.03, height}, {0, 0.03, height})});
    // Those about the crossing, of 20: within .3 of the distance of the axes.
    EXPECT_GT(Count(ways[0]), 0) << diameters;
    EXPECT_LT(Count(ways[0]), 5) << diameters;
    EXPECT_GT(ways[0][10].z(), 0.9) << diameters;
    EXPECT_LT(ways[1][10].z(), -0.9) << diameters;
  }
}

TEST(FindGrazingWays, TubesThatAreClearOrOverlapDoNotGraze) {
  for (const double diameters : {0.5, 0.9, 1.1}) {
    const double height = 2 * kRadius * diameters;
    const auto ways = FindGrazingWays(
        {Line({-0.03, 0, 0}, {0.03, 0, 0}), Line({0, -0.03, height}, {0, 0.03, height})});
    EXPECT_EQ(Count(ways[0]) + Count(ways[1]), 0) << diameters;
  }
}

TEST(FindGrazingWays, TubesThatComeTogetherInANodeDoNot) {
  for (const double degrees : {60, 90, 150, 180}) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto ways =
        FindGrazingWays({Line({0, 0, 0}, {0.03, 0, 0}),
                         Line({0, 0, 0}, 0.03 * Vec3(std::cos(angle), std::sin(angle), 0))});
    EXPECT_EQ(Count(ways[0]) + Count(ways[1]), 0) << degrees;
  }
}

// A hairpin whose legs lie two radii apart grazes itself; the bend is none of it.
TEST(FindGrazingWays, ATubeThatReturnsGrazesItself) {
  Polyline points = Line({0, 0, 0}, {0.03, 0, 0}).points;
  for (int i = 1; i <= 12; ++i) {
    const double a = std::numbers::pi * i / 12;
    points.emplace_back(0.03 + kRadius * std::sin(a), kRadius * (1 - std::cos(a)), 0);
  }
  for (int i = 1; i <= 10; ++i) points.emplace_back(0.03 - kRadius * i, 2 * kRadius, 0);
  const std::vector<Vec3> ways = FindGrazingWays({AxisOf(points)})[0];
  EXPECT_GT(ways[3].y(), 0.9);
  EXPECT_LT(ways[ways.size() - 4].y(), -0.9);
  EXPECT_TRUE(ways[15].isZero());
}

}  // namespace
}  // namespace curvefusion
