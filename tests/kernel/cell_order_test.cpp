#include "kernel/cell_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace curvefusion {
namespace {

void ExpectOrderOfAStableSort(const std::vector<VoxelKey>& cells) {
  std::vector<int> order(cells.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int i) { return cells[i]; });
  std::vector<VoxelKey> sorted = cells;
  EXPECT_EQ(SortCells(sorted), order);
  EXPECT_TRUE(std::ranges::is_sorted(sorted));
}

std::vector<VoxelKey> RandomCells(int count, int least, int greatest) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(least, greatest);
  std::vector<VoxelKey> cells(count);
  for (VoxelKey& cell : cells) cell = {coordinate(random), coordinate(random), coordinate(random)};
  return cells;
}

TEST(CellOrder, IsThatOfAStableSort) {
  for (const int extent : {1, 5, 1500, 3'000'000}) {  // none, one, one and two digits a coordinate
    SCOPED_TRACE(extent);
    ExpectOrderOfAStableSort(RandomCells(5000, -extent, extent));
  }
}

TEST(CellOrder, HoldsForTheOutermostCells) {
  constexpr int kLeast = std::numeric_limits<int>::min();
  constexpr int kGreatest = std::numeric_limits<int>::max();
  std::vector<VoxelKey> cells = RandomCells(1000, kLeast, kGreatest);
  cells.push_back({kGreatest, kLeast, 0});
  cells.push_back({kLeast, kGreatest, kGreatest});
  ExpectOrderOfAStableSort(cells);
}

TEST(CellOrder, KeepsEqualCellsInTheirOrder) {
  std::vector<VoxelKey> cells = {{2, 1, 0}, {2, 1, 0}, {2, 0, 5}, {2, 1, 0}};
  EXPECT_EQ(SortCells(cells), (std::vector<int>{2, 0, 1, 3}));
  cells.clear();
  EXPECT_TRUE(SortCells(cells).empty());
}

}  // namespace
}  // namespace curvefusion
