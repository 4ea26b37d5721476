#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Points sorted into the cells of a regular grid, for very many queries of one radius over dense
/// points, where it takes about a quarter of the time of a tree. Thread-safe for concurrent
/// queries. Building is linear in the points and in the cells that lie along x between the
/// outermost points, two million at most.
class PointGrid {
 public:
  /// For queries of about `radius`, metres, positive. `points` must be finite. Keeps a copy.
  PointGrid(const std::vector<Vec3>& points, double radius);

  /// Calls visit(index, position) for all points within `radius` (inclusive) of p, in an order that
  /// depends on the points only.
  template <class Visit>
  void ForEachWithin(const Vec3& p, double radius, const Visit& visit) const;

  /// The points of an occupied cell: [first, last) of order(). The outermost cells, which hold all
  /// points beyond them, have no bounds.
  struct CellPoints {
    Vec3 center;
    int first;
    int last;
    bool is_bounded;
  };

  /// Calls visit(CellPoints) for the occupied cells that overlap the box from `low` to `high`, in
  /// ascending order of `first`.
  template <class Visit>
  void ForEachCell(const Vec3& low, const Vec3& high, const Visit& visit) const;

  /// The centre of the cell in which p lies.
  Vec3 CellCenterAt(const Vec3& p) const {
    return {CellCenter(Coordinate(p.x())), CellCenter(Coordinate(p.y())),
            CellCenter(Coordinate(p.z()))};
  }

  /// Index of the nearest point within `max_distance` (inclusive) of p, the lowest of several; -1
  /// where there is none. The faster the nearer it is.
  int Nearest(const Vec3& p, double max_distance) const;

  /// The points' indices, sorted by cell.
  const std::vector<int>& order() const { return indices_; }

  double cell_size() const { return cell_size_; }

 private:
  // One cell's points: [first, next cell's first) in points_ and indices_.
  struct Cell {
    uint64_t key;
    int first;
  };
  // The cells above one another: [first, next column's first) in cells_.
  struct Column {
    uint64_t key;
    int first;
  };

  static constexpr int64_t kCellsPerAxis = int64_t{1} << 21;
  static constexpr int64_t kHalfOfAxis = int64_t{1} << 20;

  // Far outliers share the outermost cells: clamping keeps neighbours in neighbouring cells.
  int64_t Coordinate(double x) const {
    const auto half = static_cast<double>(kHalfOfAxis);
    return static_cast<int64_t>(std::clamp(std::floor(x / cell_size_) + half, 0.0, 2 * half - 1));
  }
  static bool IsOutermost(int64_t coordinate) {
    return coordinate == 0 || coordinate == kCellsPerAxis - 1;
  }
  double CellCenter(int64_t coordinate) const {
    return (static_cast<double>(coordinate - kHalfOfAxis) + 0.5) * cell_size_;
  }
  static uint64_t ColumnKey(int64_t x, int64_t y) {
    return (static_cast<uint64_t>(x) << 21) | static_cast<uint64_t>(y);
  }
  static uint64_t Key(int64_t x, int64_t y, int64_t z) {
    return (ColumnKey(x, y) << 21) | static_cast<uint64_t>(z);
  }

  // As ForEachCell, but whole columns of cells in one range: visit(first, last of order()). Columns
  // for which keep(x, y of the centre) is false are left out.
  template <class Keep, class Visit>
  void ForEachRange(const Vec3& low, const Vec3& high, const Keep& keep, const Visit& visit) const;

  // Calls visit(x, y, first, last) for the cells of each column in the box for which keep(x, y).
  template <class Keep, class Visit>
  void ForEachColumnPart(const Vec3& low, const Vec3& high, const Keep& keep,
                         const Visit& visit) const;

  // The first of a sorted range whose key is not less.
  template <class Entry>
  static const Entry* FirstFrom(const Entry* first, const Entry* last, uint64_t key) {
    return std::lower_bound(first, last, key,
                            [](const Entry& entry, uint64_t k) { return entry.key < k; });
  }

  double cell_size_;
  std::vector<Cell> cells_;      ///< ascending keys, one past the end closes the last
  std::vector<Column> columns_;  ///< likewise
  int64_t first_x_ = 0;          ///< the least of all cells
  std::vector<int> slabs_;       ///< by x from first_x_: its first in columns_; one past the end
  std::vector<Vec3> points_;
  std::vector<int> indices_;
};

template <class Keep, class Visit>
void PointGrid::ForEachColumnPart(const Vec3& low, const Vec3& high, const Keep& keep,
                                  const Visit& visit) const {
  const int64_t low_y = Coordinate(low.y()), high_y = Coordinate(high.y());
  const int64_t low_z = Coordinate(low.z()), high_z = Coordinate(high.z());
  const int64_t end_x = first_x_ + static_cast<int64_t>(slabs_.size()) - 1;
  const int64_t last_x = std::min(Coordinate(high.x()), end_x - 1);
  for (int64_t x = std::max(Coordinate(low.x()), first_x_); x <= last_x; ++x) {
    const Column* column = columns_.data() + slabs_[x - first_x_];
    const Column* end = columns_.data() + slabs_[x - first_x_ + 1];
    const uint64_t last_column = ColumnKey(x, high_y);
    column = FirstFrom(column, end, ColumnKey(x, low_y));
    for (; column != end && column->key <= last_column; ++column) {
      const auto y = static_cast<int64_t>(column->key & (kCellsPerAxis - 1));
      if (!keep(x, y)) continue;
      const Cell* top = cells_.data() + (column + 1)->first;
      const Cell* first = FirstFrom(cells_.data() + column->first, top, Key(x, y, low_z));
      const Cell* last = first;
      const uint64_t last_key = Key(x, y, high_z);
      while (last != top && last->key <= last_key) ++last;
      if (first != last) visit(x, y, first, last);
    }
  }
}

template <class Keep, class Visit>
void PointGrid::ForEachRange(const Vec3& low, const Vec3& high, const Keep& keep,
                             const Visit& visit) const {
  ForEachColumnPart(
      low, high,
      [&](int64_t x, int64_t y) {
        return IsOutermost(x) || IsOutermost(y) || keep(CellCenter(x), CellCenter(y));
      },
      [&](int64_t, int64_t, const Cell* first, const Cell* last) {
        visit(first->first, last->first);
      });
}

template <class Visit>
void PointGrid::ForEachCell(const Vec3& low, const Vec3& high, const Visit& visit) const {
  ForEachColumnPart(
      low, high, [](int64_t, int64_t) { return true; },
      [&](int64_t x, int64_t y, const Cell* first, const Cell* last) {
        for (const Cell* cell = first; cell != last; ++cell) {
          const auto z = static_cast<int64_t>(cell->key & (kCellsPerAxis - 1));
          visit(CellPoints{{CellCenter(x), CellCenter(y), CellCenter(z)},
                           cell->first,
                           (cell + 1)->first,
                           !IsOutermost(x) && !IsOutermost(y) && !IsOutermost(z)});
        }
      });
}

template <class Visit>
void PointGrid::ForEachWithin(const Vec3& p, double radius, const Visit& visit) const {
  const double squared_radius = radius * radius;
  // A column whose centre is farther holds nothing within the radius.
  const double reach = radius + cell_size_;
  const auto is_near = [&](double x, double y) {
    const double dx = x - p.x(), dy = y - p.y();
    return dx * dx + dy * dy <= reach * reach;
  };
  ForEachRange(p - Vec3::Constant(radius), p + Vec3::Constant(radius), is_near,
               [&](int first, int last) {
                 for (int i = first; i < last; ++i) {
                   if ((points_[i] - p).squaredNorm() <= squared_radius) {
                     visit(indices_[i], points_[i]);
                   }
                 }
               });
}

}  // namespace curvefusion
