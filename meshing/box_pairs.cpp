#include "meshing/box_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace curvefusion {

namespace {

// A box lies in this many cells on average at most; the grid is coarsened until that holds.
constexpr double kMaxCellsPerBox = 6;
constexpr int kBitsPerAxis = 21;

using Cell = std::array<int64_t, 3>;

class Grid {
 public:
  explicit Grid(const std::vector<Eigen::AlignedBox3d>& boxes) : boxes_(boxes) {
    Eigen::AlignedBox3d all;
    double extent = 0;
    for (const Eigen::AlignedBox3d& box : boxes) {
      all.extend(box);
      extent += box.sizes().maxCoeff();
    }
    origin_ = all.min();
    // No finer than the packed cell numbers can tell apart.
    cell_ = std::max(extent / static_cast<double>(boxes.size()),
                     all.sizes().maxCoeff() / ((1 << kBitsPerAxis) - 2.0));
    if (cell_ <= 0) cell_ = 1;
    while (CellCount() > kMaxCellsPerBox * static_cast<double>(boxes.size())) cell_ *= 1.5;
  }

  // Cells packed into one number each, with the boxes in them, in the order of cells.
  std::vector<std::pair<uint64_t, int>> Entries() const {
    std::vector<std::pair<uint64_t, int>> entries;
    for (size_t i = 0; i < boxes_.size(); ++i) {
      const Cell low = CellOf(boxes_[i].min());
      const Cell high = CellOf(boxes_[i].max());
      for (int64_t x = low[0]; x <= high[0]; ++x) {
        for (int64_t y = low[1]; y <= high[1]; ++y) {
          for (int64_t z = low[2]; z <= high[2]; ++z) {
            entries.emplace_back(Pack({x, y, z}), static_cast<int>(i));
          }
        }
      }
    }
    std::sort(entries.begin(), entries.end());
    return entries;
  }

  // Two boxes share several cells; the one with the lowest corner of what they share counts.
  bool Owns(uint64_t cell, int i, int j) const {
    return Pack(CellOf(boxes_[i].min().cwiseMax(boxes_[j].min()))) == cell;
  }

 private:
  static uint64_t Pack(const Cell& cell) {
    return (static_cast<uint64_t>(cell[0]) << (2 * kBitsPerAxis)) |
           (static_cast<uint64_t>(cell[1]) << kBitsPerAxis) | static_cast<uint64_t>(cell[2]);
  }

  Cell CellOf(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = (p - origin_) / cell_;
    return {static_cast<int64_t>(q.x()), static_cast<int64_t>(q.y()), static_cast<int64_t>(q.z())};
  }

  double CellCount() const {
    double count = 0;
    for (const Eigen::AlignedBox3d& box : boxes_) {
      const Cell low = CellOf(box.min());
      const Cell high = CellOf(box.max());
      count += static_cast<double>((high[0] - low[0] + 1) * (high[1] - low[1] + 1)) *
               static_cast<double>(high[2] - low[2] + 1);
    }
    return count;
  }

  const std::vector<Eigen::AlignedBox3d>& boxes_;
  Eigen::Vector3d origin_;
  double cell_ = 1;
};

// Sorts pairs of indices below n, by the first in linear time: a box meets few others.
std::vector<std::pair<int, int>> Sorted(const std::vector<std::pair<int, int>>& pairs, size_t n) {
  std::vector<size_t> end(n + 1, 0);
  for (const auto& [i, j] : pairs) ++end[i + 1];
  for (size_t i = 0; i < n; ++i) end[i + 1] += end[i];
  std::vector<std::pair<int, int>> sorted(pairs.size());
  for (const auto& pair : pairs) sorted[end[pair.first]++] = pair;
  size_t begin = 0;
  for (size_t i = 0; i < n; begin = end[i++]) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin),
              sorted.begin() + static_cast<std::ptrdiff_t>(end[i]));
  }
  return sorted;
}

}  // namespace

std::vector<std::pair<int, int>> OverlappingBoxes(const std::vector<Eigen::AlignedBox3d>& boxes) {
  std::vector<std::pair<int, int>> pairs;
  if (boxes.empty()) return pairs;
  const Grid grid(boxes);
  const std::vector<std::pair<uint64_t, int>> entries = grid.Entries();
  for (size_t first = 0, end = 0; first < entries.size(); first = end) {
    while (end < entries.size() && entries[end].first == entries[first].first) ++end;
    for (size_t a = first; a < end; ++a) {
      for (size_t b = a + 1; b < end; ++b) {
        const auto [i, j] = std::pair(entries[a].second, entries[b].second);
        if (boxes[i].intersects(boxes[j]) && grid.Owns(entries[first].first, i, j)) {
          pairs.emplace_back(i, j);
        }
      }
    }
  }
  return Sorted(pairs, boxes.size());
}

}  // namespace curvefusion
