#include "kernel/voxel_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace curvefusion {
namespace {

TEST(VoxelGrid, MergesPointsOfOneCellByCount) {
  ObservedPoints points;
  points.Add({0.001, 0.001, 0.001}, {0, 0, 1}, 1);
  points.Add({0.009, 0.001, 0.001}, {0, 1, 0}, 3);
  points.Add({-0.001, 0.001, 0.001}, {1, 0, 0}, 1);  // across zero: another cell
  const ObservedPoints resampled = ResampleOnGrid(points, 0.01);
  ASSERT_EQ(resampled.size(), 2u);
  EXPECT_NEAR(resampled.positions[0].x(), 0.007, 1e-12);
  EXPECT_EQ(resampled.counts[0], 4);
  EXPECT_NEAR(resampled.viewing_rays[0].norm(), 1, 1e-12);
  EXPECT_EQ(resampled.positions[1], points.positions[2]);
}

TEST(VoxelNumbers, NumbersByFirstOccurrenceWhateverTheCells) {
  VoxelNumbers numbers;
  const auto key = [](int i) { return VoxelKey{i % 20 - 10, i / 20 % 20 - 10, -(i / 400)}; };
  constexpr int kCount = 8000;  // more than the table starts with, so that it grows
  for (int i = 0; i < kCount; ++i) EXPECT_EQ(numbers.Number(key(i)), i);
  for (int i = 0; i < kCount; ++i) {
    EXPECT_EQ(numbers.Number(key(i)), i);
    EXPECT_EQ(numbers.Find(key(i)), i);
    EXPECT_EQ(numbers.key(i), key(i));
  }
  EXPECT_EQ(numbers.size(), kCount);
  EXPECT_EQ(numbers.Find({100, 0, 0}), VoxelNumbers::kNone);
}

TEST(VoxelGrid, CellsComeInTheOrderOfTheirFirstPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-0.1, 0.1);
  constexpr double kVoxel = 0.02;
  ObservedPoints points;
  for (int i = 0; i < 20000; ++i) {  // several chunks, and all cells many times
    points.Add({coordinate(random), coordinate(random), coordinate(random)}, Vec3::UnitX(), 1);
  }
  std::vector<VoxelKey> order;
  for (const Vec3& p : points.positions) {
    const VoxelKey key = VoxelOf(p, kVoxel);
    if (std::find(order.begin(), order.end(), key) == order.end()) order.push_back(key);
  }
  const ObservedPoints resampled = ResampleOnGrid(points, kVoxel);
  ASSERT_EQ(resampled.size(), order.size());
  float count = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(VoxelOf(resampled.positions[i], kVoxel), order[i]);
    count += resampled.counts[i];
  }
  EXPECT_EQ(count, 20000);
}

TEST(VoxelGrid, MovedCloudsBecomeWhatTheyWouldTogether) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-0.1, 0.1);
  std::vector<ObservedPoints> clouds(4);
  std::vector<RigidTransform> motions;
  ObservedPoints together;
  for (size_t c = 0; c < clouds.size(); ++c) {
    for (size_t i = 0; i < 1000 * c; ++i) {  // the first is empty
      const Vec3 ray = Vec3(coordinate(random), coordinate(random), 1).normalized();
      clouds[c].Add({coordinate(random), coordinate(random), coordinate(random)}, ray,
                    static_cast<float>(1 + i % 3));
    }
    motions.push_back(RigidTransform(Eigen::Translation3d(0.01 * static_cast<double>(c), 0, 0) *
                                     Eigen::AngleAxisd(coordinate(random), Vec3::UnitY())));
    Append(together, Transformed(clouds[c], motions[c]));
  }
  const ObservedPoints expected = ResampleOnGrid(together, 0.02);
  const ObservedPoints resampled = ResampleOnGrid(clouds, motions, 0.02);
  EXPECT_EQ(resampled.positions, expected.positions);
  EXPECT_EQ(resampled.viewing_rays, expected.viewing_rays);
  EXPECT_EQ(resampled.counts, expected.counts);
}

TEST(VoxelGrid, EmptyStaysEmpty) {
  EXPECT_TRUE(ResampleOnGrid({}, 0.01).empty());
  EXPECT_EQ(GroupByCell({}, 0.01).size(), 0);
}

TEST(GroupByCell, HoldsEveryPlaceOnceInItsCell) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-0.1, 0.1);
  constexpr double kVoxel = 0.05;
  std::vector<Vec3> places(5000);  // more than one chunk
  for (Vec3& p : places) p = {coordinate(random), coordinate(random), coordinate(random)};
  const Buckets cells = GroupByCell(places, kVoxel);
  EXPECT_EQ(cells.size(), 4 * 4 * 4);
  std::vector<int> seen;
  for (int cell = 0; cell < cells.size(); ++cell) {
    const VoxelKey key = VoxelOf(places[cells[cell].front()], kVoxel);
    if (cell > 0) {
      EXPECT_LT(VoxelOf(places[cells[cell - 1].front()], kVoxel), key);
    }
    EXPECT_TRUE(std::ranges::is_sorted(cells[cell]));
    for (const int i : cells[cell]) {
      EXPECT_EQ(VoxelOf(places[i], kVoxel), key);
      seen.push_back(i);
    }
  }
  std::ranges::sort(seen);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(seen[i], i);
}

}  // namespace
}  // namespace curvefusion
