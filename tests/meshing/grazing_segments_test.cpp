#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshing/contacts.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;

TubePath PathOf(const Polyline& points) {
  return {{points, std::vector<double>(points.size(), kRadius)}, false, {}};
}

// A straight line in steps of a radius.
TubePath Line(const Vec3& from, const Vec3& to) { return PathOf(Resample({from, to}, kRadius)); }

int64_t Count(const std::vector<char>& grazing) {
  return std::count(grazing.begin(), grazing.end(), 1);
}

// Two tubes that cross so many diameters apart.
std::vector<std::vector<char>> Crossing(double diameters) {
  const double height = 2 * kRadius * diameters;
  return FindGrazingSegments(
      {Line({-0.03, 0, 0}, {0.03, 0, 0}), Line({0, -0.03, height}, {0, 0.03, height})});
}

TEST(FindGrazingSegments, TubesThatCrossAtTouchingDistance) {
  for (const double diameters : {0.85, 1.0, 1.07}) {
    const auto grazing = Crossing(diameters);
    // Those about the crossing, of 20: within .3 of the distance of the axes.
    EXPECT_GT(Count(grazing[0]), 0) << diameters;
    EXPECT_LT(Count(grazing[0]), 5) << diameters;
    EXPECT_TRUE(grazing[0][10]) << diameters;
    EXPECT_TRUE(grazing[1][10]) << diameters;
  }
}

TEST(FindGrazingSegments, TubesThatAreClearOrOverlapDoNotGraze) {
  for (const double diameters : {0.5, 0.7, 1.15}) {
    const auto grazing = Crossing(diameters);
    EXPECT_EQ(Count(grazing[0]) + Count(grazing[1]), 0) << diameters;
  }
}

TEST(FindGrazingSegments, TubesThatComeTogetherInANodeDoNot) {
  for (const double degrees : {60, 90, 150, 180}) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto grazing =
        FindGrazingSegments({Line({0, 0, 0}, {0.03, 0, 0}),
                             Line({0, 0, 0}, 0.03 * Vec3(std::cos(angle), std::sin(angle), 0))});
    EXPECT_EQ(Count(grazing[0]) + Count(grazing[1]), 0) << degrees;
  }
}

// A hairpin whose legs lie two radii apart grazes itself; the bend is none of it.
TEST(FindGrazingSegments, ATubeThatReturnsGrazesItself) {
  Polyline points = Line({0, 0, 0}, {0.03, 0, 0}).axis.points;
  for (int i = 1; i <= 12; ++i) {
    const double a = std::numbers::pi * i / 12;
    points.emplace_back(0.03 + kRadius * std::sin(a), kRadius * (1 - std::cos(a)), 0);
  }
  for (int i = 1; i <= 10; ++i) points.emplace_back(0.03 - kRadius * i, 2 * kRadius, 0);
  const std::vector<char> grazing = FindGrazingSegments({PathOf(points)})[0];
  EXPECT_TRUE(grazing[3]);
  EXPECT_TRUE(grazing[grazing.size() - 4]);
  EXPECT_FALSE(grazing[15]);
}

}  // namespace
}  // namespace curvefusion
