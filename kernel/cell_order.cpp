#include "kernel/cell_order.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>

namespace curvefusion {

namespace {

// The counts of so many bits stay in the cache.
constexpr int kBitsPerDigit = 11;
constexpr uint32_t kDigitMask = (uint32_t{1} << kBitsPerDigit) - 1;

struct IndexedCell {
  VoxelKey cell;
  int index;
};

// Sorts by some bits of one coordinate, keeping the order of what is equal in them.
template <class Digit>
void SortByDigit(const Digit& digit, std::vector<IndexedCell>& items,
                 std::vector<IndexedCell>& sorted) {
  std::array<int, kDigitMask + 2> firsts{};
  for (const IndexedCell& item : items) ++firsts[digit(item) + 1];
  std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
  for (const IndexedCell& item : items) sorted[firsts[digit(item)]++] = item;
  items.swap(sorted);
}

}  // namespace

std::vector<int> OrderByCell(const std::vector<VoxelKey>& cells) {
  std::vector<IndexedCell> items(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) items[i] = {cells[i], static_cast<int>(i)};
  std::vector<IndexedCell> sorted(cells.size());
  for (int VoxelKey::*axis : {&VoxelKey::z, &VoxelKey::y, &VoxelKey::x}) {
    if (cells.empty()) break;
    const auto [least, greatest] = std::ranges::minmax(cells, {}, axis);
    const auto offset = static_cast<uint32_t>(least.*axis);
    const int bits = std::bit_width(static_cast<uint32_t>(greatest.*axis) - offset);
    for (int shift = 0; shift < bits; shift += kBitsPerDigit) {
      SortByDigit(
          [=](const IndexedCell& item) {
            return (static_cast<uint32_t>(item.cell.*axis) - offset) >> shift & kDigitMask;
          },
          items, sorted);
    }
  }
  std::vector<int> order(cells.size());
  std::ranges::transform(items, order.begin(), &IndexedCell::index);
  return order;
}

}  // namespace curvefusion
