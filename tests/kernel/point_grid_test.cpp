#include "kernel/point_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace curvefusion {
namespace {

std::vector<Vec3> RandomPoints(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> inside(-0.05, 0.05);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(inside(random), inside(random), inside(random));
  }
  return points;
}

std::vector<int> Found(const PointGrid& grid, const Vec3& p, double radius) {
  std::vector<int> found;
  grid.ForEachWithin(p, radius, [&](int index, const Vec3&) { found.push_back(index); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<int> FoundByBruteForce(const std::vector<Vec3>& points, const Vec3& p, double radius) {
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    if ((points[i] - p).squaredNorm() <= radius * radius) found.push_back(i);
  }
  return found;
}

TEST(PointGrid, FindsWhatBruteForceFinds) {
  const std::vector<Vec3> points = RandomPoints(500);
  const PointGrid grid(points, 0.011);
  int found = 0;
  for (const double radius : {0.002, 0.007, 0.011}) {
    for (const Vec3& p : RandomPoints(200)) {
      const std::vector<int> expected = FoundByBruteForce(points, p, radius);
      EXPECT_EQ(Found(grid, p, radius), expected);
      found += static_cast<int>(expected.size());
    }
  }
  EXPECT_GT(found, 1000);  // the comparison is not of empty sets
}

TEST(PointGrid, VisitsPositionsWithTheirIndices) {
  const std::vector<Vec3> points = RandomPoints(50);
  PointGrid(points, 0.2).ForEachWithin(Vec3::Zero(), 0.2, [&](int index, const Vec3& p) {
    EXPECT_EQ(p, points[index]);
  });
}

TEST(PointGrid, FarOutliersStayNeighboursOfTheirNeighbours) {
  const std::vector<Vec3> points{{1e12, 0, 0}, {1e12, 0.001, 0}, {-1e12, 0, 0}, {0, 0, 0}};
  const PointGrid grid(points, 0.01);
  EXPECT_EQ(Found(grid, points[0], 0.01), (std::vector<int>{0, 1}));
  EXPECT_EQ(Found(grid, points[2], 0.01), (std::vector<int>{2}));
}

TEST(PointGrid, CellsOverABoxHoldItsPoints) {
  const std::vector<Vec3> points = RandomPoints(500);
  const PointGrid grid(points, 0.011);
  const Vec3 low(-0.02, -0.01, 0), high(0.01, 0.03, 0.04);
  std::vector<int> found;
  int last = 0;
  grid.ForEachCell(low, high, [&](const PointGrid::CellPoints& cell) {
    EXPECT_GE(cell.first, last);
    EXPECT_TRUE(cell.is_bounded);
    last = cell.last;
    for (int i = cell.first; i < cell.last; ++i) {
      found.push_back(grid.order()[i]);
      const Vec3 offset = points[grid.order()[i]] - cell.center;
      EXPECT_LE(offset.lpNorm<Eigen::Infinity>(), 0.5001 * grid.cell_size());
      EXPECT_EQ(grid.CellCenterAt(points[grid.order()[i]]), cell.center);
    }
  });
  int inside = 0;
  for (int i = 0; i < 500; ++i) {
    if ((points[i].array() < low.array()).any() || (points[i].array() > high.array()).any()) {
      continue;
    }
    ++inside;
    EXPECT_EQ(std::count(found.begin(), found.end(), i), 1);
  }
  EXPECT_GT(inside, 20);
  EXPECT_LT(found.size(), 200u);  // not all
}

TEST(PointGrid, NearestIsThatOfBruteForce) {
  std::vector<Vec3> points = RandomPoints(200);
  points.push_back(points[17]);  // of two equally near the first is taken
  const PointGrid grid(points, 0.004);
  int found = 0, missed = 0;
  for (const double reach : {0.003, 0.01, 0.3}) {
    for (const Vec3& p : RandomPoints(100)) {
      const Vec3 query = 1.3 * p;
      const auto nearest =
          std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
            return (a - query).squaredNorm() < (b - query).squaredNorm();
          });
      const bool is_near = (*nearest - query).norm() <= reach;
      EXPECT_EQ(grid.Nearest(query, reach),
                is_near ? static_cast<int>(nearest - points.begin()) : -1);
      ++(is_near ? found : missed);
    }
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(missed, 20);
}

TEST(PointGrid, EmptyFindsNothing) {
  EXPECT_EQ(PointGrid({}, 0.01).Nearest(Vec3::Zero(), 1), -1);
  EXPECT_TRUE(Found(PointGrid({}, 0.01), Vec3::Zero(), 0.01).empty());
}

}  // namespace
}  // namespace curvefusion
