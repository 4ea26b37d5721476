#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Points sorted into the cells of a regular grid, for very many queries of one radius over dense
/// points, where it takes about half the time of a tree. Thread-safe for concurrent queries.
/// Building costs O(n log n).
class PointGrid {
 public:
  /// `points` must be finite and `cell_size` positive. The grid keeps a copy.
  PointGrid(const std::vector<Vec3>& points, double cell_size);

  /// Calls visit(index, position) for all points within `radius` (inclusive) of p, in an order that
  /// depends on the points only. `radius` must not exceed the cell size.
  template <class Visit>
  void ForEachWithin(const Vec3& p, double radius, const Visit& visit) const;

  double cell_size() const { return cell_size_; }

 private:
  // One cell's points: [first, next cell's first) in points_ and indices_.
  struct Cell {
    uint64_t key;
    int first;
  };

  static constexpr int64_t kCellsPerAxis = int64_t{1} << 21;

  // Far outliers share the outermost cells: clamping keeps neighbours in neighbouring cells.
  int64_t Coordinate(double x) const {
    const double half = static_cast<double>(kCellsPerAxis / 2);
    return static_cast<int64_t>(std::clamp(std::floor(x / cell_size_) + half, 1.0, 2 * half - 2));
  }
  static uint64_t Key(int64_t x, int64_t y, int64_t z) {
    return (static_cast<uint64_t>(x) << 42) | (static_cast<uint64_t>(y) << 21) |
           static_cast<uint64_t>(z);
  }

  double cell_size_;
  std::vector<Cell> cells_;  ///< ascending keys, one past the end closes the last
  std::vector<Vec3> points_;
  std::vector<int> indices_;
};

template <class Visit>
void PointGrid::ForEachWithin(const Vec3& p, double radius, const Visit& visit) const {
  const int64_t x = Coordinate(p.x());
  const int64_t y = Coordinate(p.y());
  const int64_t z = Coordinate(p.z());
  const double squared_radius = radius * radius;
  for (int column = 0; column < 9; ++column) {
    const int64_t cx = x + column / 3 - 1;
    const int64_t cy = y + column % 3 - 1;
    const uint64_t last_key = Key(cx, cy, z + 1);
    auto cell =
        std::lower_bound(cells_.begin(), cells_.end() - 1, Key(cx, cy, z - 1),
                         [](const Cell& candidate, uint64_t key) { return candidate.key < key; });
    for (; cell != cells_.end() - 1 && cell->key <= last_key; ++cell) {
      for (int i = cell->first; i < (cell + 1)->first; ++i) {
        if ((points_[i] - p).squaredNorm() <= squared_radius) visit(indices_[i], points_[i]);
      }
    }
  }
}

}  // namespace curvefusion
