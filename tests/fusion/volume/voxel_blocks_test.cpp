#include "fusion/volume/voxel_blocks.h"

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
  grid.SetSigns(0, FindSigns(grid.block(0)));
  EXPECT_FALSE(grid.HasInside(0));
  EXPECT_FALSE(grid.HasOutside(0));
}

}  // namespace
}  // namespace curvefusion
