#include "kernel/morton_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace curvefusion {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<Vec3> SomePoints() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> power(-300, 300);
  std::vector<Vec3> points = {Vec3::Zero(), {0, 1e-310, 0}, {0, -1e-310, 0}};
  for (int i = 0; i < 300; ++i) {
    const double size = i % 2 == 0 ? 1 : std::ldexp(1, power(random));
    points.emplace_back(size * unit(random), size * unit(random), unit(random));
    const Vec3 p = points.back();
    points.emplace_back(p.x(), std::nextafter(p.y(), kFar), p.z());
  }
  return points;
}

TEST(MortonOrder, IsTotalAndAgreesWithTheCode) {
  std::vector<Vec3> points = SomePoints();
  std::sort(points.begin(), points.end(), ComesBefore);
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = 0; j < points.size(); ++j) {
      EXPECT_EQ(ComesBefore(points[i], points[j]), i < j) << i << " " << j;
      if (i < j) {
        EXPECT_LE(MortonCode(points[i]), MortonCode(points[j]));
      }
    }
  }
}

TEST(MortonOrder, BothZerosAreOne) {
  EXPECT_FALSE(ComesBefore({0.0, 1, 2}, {-0.0, 1, 2}));
  EXPECT_FALSE(ComesBefore({-0.0, 1, 2}, {0.0, 1, 2}));
  EXPECT_EQ(MortonCode({0.0, 1, 2}), MortonCode({-0.0, 1, 2}));
}

TEST(MortonOrder, OctantsOfACubeComeOneAfterTheOther) {
  // All of each octant of [1, 2)^3 before any of the next; x decides first.
  const std::vector<double> halves = {1.25, 1.75};
  std::vector<Vec3> centres;
  for (const double x : halves)
    for (const double y : halves)
      for (const double z : halves) centres.emplace_back(x, y, z);
  for (size_t i = 0; i + 1 < centres.size(); ++i) {
    const Vec3 last = centres[i] + Vec3::Constant(0.25 - 1e-15);
    const Vec3 first = centres[i + 1] - Vec3::Constant(0.25);
    EXPECT_TRUE(ComesBefore(last, first)) << i;
  }
}

// What it is for: walking along the order, steps are short. In lexicographic order they are half as
// long as the cube is wide.
TEST(MortonOrder, NeighboursInOrderAreNearInSpace) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 10000; ++i) points.emplace_back(unit(random), unit(random), unit(random));
  std::sort(points.begin(), points.end(), ComesBefore);
  double length = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  // Points are about 0.09 apart.
  EXPECT_LT(length / 10000, 0.2);
}

}  // namespace
}  // namespace curvefusion
