#include "kernel/spatial_search.h"

#include <gtest/gtest.h>

#include <random>

namespace curvefusion {
namespace {

std::vector<Vec3> RandomPoints(int n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Vec3> points(n);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

TEST(PointIndex, AgreesWithBruteForce) {
  const std::vector<Vec3> points = RandomPoints(500);
  const PointIndex index(points);
  std::vector<int> found;
  for (const Vec3& query : RandomPoints(50)) {
    index.WithinRadius(query, 0.2, found);
    std::vector<int> expected;
    int nearest = 0;
    for (int i = 0; i < 500; ++i) {
      if ((points[i] - query).norm() <= 0.2) expected.push_back(i);
      if ((points[i] - query).norm() < (points[nearest] - query).norm()) nearest = i;
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(index.Nearest(query), nearest);
    EXPECT_EQ(index.NearestK(query, 7).size(), 7u);
    EXPECT_EQ(index.NearestK(query, 7)[0], nearest);
  }
}

TEST(PointIndex, EmptyIndexFindsNothing) {
  const PointIndex index({});
  std::vector<int> found = {1};
  index.WithinRadius(Vec3::Zero(), 1, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(index.Nearest(Vec3::Zero()), -1);
}

TEST(PointIndex, CoincidentPointsAreAllFound) {
  const PointIndex index(std::vector<Vec3>(100, Vec3(1, 1, 1)));
  std::vector<int> found;
  index.WithinRadius(Vec3(1, 1, 1), 0.1, found);
  EXPECT_EQ(found.size(), 100u);
}

}  // namespace
}  // namespace curvefusion
