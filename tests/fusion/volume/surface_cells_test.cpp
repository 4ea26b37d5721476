#include "fusion/volume/surface_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace curvefusion {
namespace {

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
  for (int block = 0; block < 7; ++block) grid.SetSigns(block, FindSigns(grid.block(block)));
  GatherCellCorners(grid, 0, corners);
  FindSurfaceCells(grid, 0, cells);
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

TEST(SurfaceCells, ABlockOfOneSignNextToOneOfTheOtherHasASurface) {
  VoxelBlockGrid grid;
  grid.Insert({0, 0, 0});
  grid.Insert({1, 0, 0});
  grid.block(0).tsdf.fill(1);
  grid.block(1).tsdf.fill(-1);
  for (const int block : {0, 1}) grid.SetSigns(block, FindSigns(grid.block(block)));
  EXPECT_TRUE(MayContainSurface(grid, 0));
  EXPECT_FALSE(MayContainSurface(grid, 1));
  const std::vector<SurfaceBlock> blocks = FindSurfaceBlocks(grid);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].block, 0);
  // Cells at the far y and z faces lack a neighbouring block.
  EXPECT_EQ(blocks[0].box.low, (std::array<int8_t, 3>{7, 0, 0}));
  EXPECT_EQ(blocks[0].box.high, (std::array<int8_t, 3>{8, 7, 7}));
}

}  // namespace
}  // namespace curvefusion
