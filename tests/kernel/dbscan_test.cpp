#include "kernel/dbscan.h"

#include <gtest/gtest.h>

#include <random>

namespace curvefusion {
namespace {

TEST(Dbscan, SeparatesTwoClustersAndNoise) {
  std::vector<Vec3> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(0.001 * i, 0, 0);
  for (int i = 0; i < 10; ++i) points.emplace_back(0.001 * i, 1, 0);
  points.emplace_back(5, 5, 5);
  const std::vector<int> labels = Dbscan(points, 0.0015, 3);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(labels[i], 0);
  for (int i = 10; i < 20; ++i) EXPECT_EQ(labels[i], 1);
  EXPECT_EQ(labels[20], kNoise);
  const std::vector<std::vector<int>> clusters = ClustersOf(labels);
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_EQ(clusters[0], std::vector<int>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(clusters[1].front(), 10);
  EXPECT_EQ(clusters[1].back(), 19);
}

TEST(Dbscan, EmptyInputGivesNoLabels) { EXPECT_TRUE(Dbscan({}, 0.01, 3).empty()); }

TEST(Dbscan, CorePointsAgreeWithBruteForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Vec3> points(400);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  const double radius = 0.12;
  const std::vector<int> labels = Dbscan(points, radius, 4);
  const auto neighbours = [&](size_t i) {
    int count = 0;
    for (const Vec3& q : points) count += (points[i] - q).norm() <= radius;
    return count;
  };
  // Two core points within the radius of each other share their cluster; core points are not noise.
  for (size_t i = 0; i < points.size(); ++i) {
    if (neighbours(i) < 4) continue;
    EXPECT_NE(labels[i], kNoise);
    for (size_t j = 0; j < i; ++j) {
      if ((points[i] - points[j]).norm() > radius || neighbours(j) < 4) continue;
      EXPECT_EQ(labels[i], labels[j]);
    }
  }
}

// As it is defined: cluster by cluster, whatever a core point reaches.
std::vector<int> BruteForce(const std::vector<Vec3>& points, double radius, int min_points) {
  const int n = static_cast<int>(points.size());
  std::vector<int> labels(n, kNoise);
  const auto neighbours = [&](int i) {
    std::vector<int> found;
    for (int j = 0; j < n; ++j) {
      if ((points[i] - points[j]).squaredNorm() <= radius * radius) found.push_back(j);
    }
    return found;
  };
  int clusters = 0;
  for (int seed = 0; seed < n; ++seed) {
    if (labels[seed] != kNoise || static_cast<int>(neighbours(seed).size()) < min_points) continue;
    std::vector<int> frontier{seed};
    labels[seed] = clusters;
    while (!frontier.empty()) {
      const std::vector<int> around = neighbours(frontier.back());
      frontier.pop_back();
      if (static_cast<int>(around.size()) < min_points) continue;
      for (const int i : around) {
        if (labels[i] != kNoise) continue;
        labels[i] = clusters;
        frontier.push_back(i);
      }
    }
    ++clusters;
  }
  return labels;
}

TEST(Dbscan, LabelsAreThoseOfTheDefinition) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  // From single points to one cluster, with border points between clusters.
  for (const double radius : {0.02, 0.12, 0.2, 0.3, 0.6}) {
    for (const int min_points : {1, 2, 4, 9}) {
      std::vector<Vec3> points(300);
      for (Vec3& p : points) {
        p = {coordinate(random), coordinate(random), 0.2 * coordinate(random)};
      }
      points[200] = points[100];
      EXPECT_EQ(Dbscan(points, radius, min_points), BruteForce(points, radius, min_points))
          << radius << " " << min_points;
    }
  }
}

}  // namespace
}  // namespace curvefusion
