#include "kernel/point_grid.h"

#include <cassert>
#include <limits>

#include "kernel/cell_order.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Smaller cells fit a ball better, larger ones are fewer to look up.
constexpr double kCellsPerRadius = 2;
constexpr int64_t kPointsPerChunk = 4096;

}  // namespace

PointGrid::PointGrid(const std::vector<Vec3>& points, double radius)
    : cell_size_(radius / kCellsPerRadius) {
  assert(radius > 0);
  std::vector<VoxelKey> cells(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), kPointsPerChunk, [&](int64_t i) {
    const Vec3& p = points[i];
    assert(p.allFinite());
    cells[i] = {static_cast<int>(Coordinate(p.x())), static_cast<int>(Coordinate(p.y())),
                static_cast<int>(Coordinate(p.z()))};
  });
  indices_ = SortCells(cells);
  points_.resize(points.size());
  for (int i = 0; i < static_cast<int>(indices_.size()); ++i) {
    points_[i] = points[indices_[i]];
    const VoxelKey& cell = cells[i];
    const uint64_t column = ColumnKey(cell.x, cell.y);
    const uint64_t key = Key(cell.x, cell.y, cell.z);
    if (columns_.empty() || columns_.back().key != column) {
      if (columns_.empty()) first_x_ = cell.x;
      slabs_.resize(cell.x - first_x_ + 1, static_cast<int>(columns_.size()));
      columns_.push_back({column, static_cast<int>(cells_.size())});
    }
    if (cells_.empty() || cells_.back().key != key) cells_.push_back({key, i});
  }
  slabs_.push_back(static_cast<int>(columns_.size()));
  columns_.push_back({~uint64_t{0}, static_cast<int>(cells_.size())});
  cells_.push_back({~uint64_t{0}, static_cast<int>(indices_.size())});
}

int PointGrid::Nearest(const Vec3& p, double max_distance) const {
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (double radius = std::min(cell_size_, max_distance);; radius *= 2) {
    radius = std::min(radius, max_distance);
    ForEachWithin(p, radius, [&](int index, const Vec3& q) {
      const double squared = (q - p).squaredNorm();
      if (squared > least || (squared == least && index > nearest)) return;
      least = squared;
      nearest = index;
    });
    if (nearest >= 0 || radius >= max_distance) return nearest;
  }
}

}  // namespace curvefusion
