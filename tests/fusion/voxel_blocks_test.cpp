#include "fusion/voxel_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace curvefusion {
namespace {

TEST(VoxelBlockGrid, FindsWhatWasInsertedAndNothingElse) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(-12, 12);
  VoxelBlockGrid grid;
  std::map<VoxelKey, int> oracle;
  for (int i = 0; i < 5000; ++i) {
    const VoxelKey key{coordinate(random), coordinate(random), coordinate(random)};
    const auto [entry, is_new] = oracle.try_emplace(key, grid.size());
    if (is_new) {
      EXPECT_EQ(grid.Find(key), VoxelBlockGrid::kNone);
      EXPECT_EQ(grid.Insert(key), entry->second);
    }
    ASSERT_EQ(grid.Find(key), entry->second);
  }
  for (const auto& [key, block] : oracle) {
    ASSERT_EQ(grid.Find(key), block);
    for (int i = 0; i < 8; ++i) {
      const auto neighbour =
          oracle.find({key.x + (i & 1), key.y + (i >> 1 & 1), key.z + (i >> 2 & 1)});
      ASSERT_EQ(grid.UpperNeighbours(block)[i],
                neighbour == oracle.end() ? VoxelBlockGrid::kNone : neighbour->second);
    }
  }
}

TEST(VoxelBlockGrid, KeysAtTheLimitAreDistinct) {
  constexpr int kMax = VoxelBlockGrid::kMaxKey;
  VoxelBlockGrid grid;
  grid.Insert({kMax, -kMax, kMax});
  grid.Insert({-kMax, kMax, -kMax});
  EXPECT_EQ(grid.Find({kMax, -kMax, kMax}), 0);
  EXPECT_EQ(grid.Find({-kMax, kMax, -kMax}), 1);
  EXPECT_EQ(grid.Find({kMax, kMax, kMax}), VoxelBlockGrid::kNone);
}

TEST(VoxelBlockGrid, NewBlocksAreUnobserved) {
  VoxelBlockGrid grid;
  grid.Insert({0, 0, 0});
  for (const float value : grid.block(0).tsdf) EXPECT_TRUE(std::isnan(value));
  EXPECT_FALSE(MayContainSurface(grid, 0));
}

// The field's value at a voxel of the whole grid.
float ValueAt(const VoxelBlockGrid& grid, int x, int y, int z) {
  const int block = grid.Find({x >> 3, y >> 3, z >> 3});
  return block == VoxelBlockGrid::kNone
             ? NAN
             : grid.block(block).tsdf[(x & 7) + 8 * (y & 7) + 64 * (z & 7)];
}

TEST(CellCorners, AreTheValuesOfTheVoxelsAcrossBlocks) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-1, 1);
  VoxelBlockGrid grid;
  // One of the eight blocks is missing.
  for (int i = 0; i < 7; ++i) {
    const int block = grid.Insert({(i & 1) - 1, (i >> 1 & 1) - 1, (i >> 2 & 1) - 1});
    for (float& tsdf : grid.block(block).tsdf) tsdf = value(random);
    grid.block(block).tsdf[100] = NAN;
  }
  CellCorners corners;
  CellMask cells;
  GatherCellCorners(grid, 0, corners);
  FindSurfaceCells(corners, cells);
  const auto corner = [&](int x, int y, int z) { return corners[x + 9 * y + 81 * z]; };
  for (int z = 0; z < 8; ++z) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        int inside = 0, outside = 0;
        for (int i = 0; i < 8; ++i) {
          const int cx = x + (i & 1), cy = y + (i >> 1 & 1), cz = z + (i >> 2 & 1);
          const float expected = ValueAt(grid, cx - 8, cy - 8, cz - 8);
          const float actual = corner(cx, cy, cz);
          ASSERT_TRUE(actual == expected || (std::isnan(actual) && std::isnan(expected)));
          inside += expected < 0;
          outside += expected >= 0;
        }
        const bool is_surface = inside > 0 && outside > 0 && inside + outside == 8;
        ASSERT_EQ(cells[y + 8 * z] >> x & 1, is_surface) << x << " " << y << " " << z;
      }
    }
  }
}

}  // namespace
}  // namespace curvefusion
