#include "kernel/cell_order.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "kernel/parallel.h"
#include "kernel/radix_sort.h"

namespace curvefusion {

namespace {

constexpr int64_t kCellsPerChunk = 1 << 15;

struct IndexedCell {
  VoxelKey cell;
  int index;
};

}  // namespace

std::vector<int> SortCells(std::vector<VoxelKey>& cells) {
  if (cells.empty()) return {};
  std::vector<IndexedCell> items(cells.size());
  const auto count = static_cast<int64_t>(cells.size());
  ParallelFor(0, count, kCellsPerChunk, [&](int64_t i) {
    items[i] = {cells[i], static_cast<int>(i)};
  });
  // Coordinates from the least on, so that they differ in few bits.
  const auto range = [&cells](int VoxelKey::*axis) {
    const auto [least, greatest] = std::ranges::minmax(cells, {}, axis);
    return std::pair(static_cast<uint32_t>(least.*axis), static_cast<uint32_t>(greatest.*axis));
  };
  const uint32_t least_x = range(&VoxelKey::x).first;
  const auto range_y = range(&VoxelKey::y);
  const uint32_t least_y = range_y.first;
  const uint32_t least_z = range(&VoxelKey::z).first;
  const int bits_y = std::bit_width(range_y.second - least_y);
  RadixSort(items, [least_z](const IndexedCell& item) {
    return uint64_t{static_cast<uint32_t>(item.cell.z) - least_z};
  });
  RadixSort(items, [=](const IndexedCell& item) {
    return uint64_t{static_cast<uint32_t>(item.cell.x) - least_x} << bits_y |
           (static_cast<uint32_t>(item.cell.y) - least_y);
  });
  std::vector<int> indices(cells.size());
  ParallelFor(0, count, kCellsPerChunk, [&](int64_t i) {
    cells[i] = items[i].cell;
    indices[i] = items[i].index;
  });
  return indices;
}

}  // namespace curvefusion
