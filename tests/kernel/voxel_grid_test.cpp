#include "kernel/voxel_grid.h"

#include <gtest/gtest.h>

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

TEST(VoxelGrid, EmptyStaysEmpty) { EXPECT_TRUE(ResampleOnGrid({}, 0.01).empty()); }

}  // namespace
}  // namespace curvefusion
