#include "kernel/point_grid.h"

#include <cassert>
#include <limits>
#include <utility>

namespace curvefusion {

namespace {

// Smaller cells fit a ball better, larger ones are fewer to look up.
constexpr double kCellsPerRadius = 2;

}  // namespace

PointGrid::PointGrid(const std::vector<Vec3>& points, double radius)
    : cell_size_(radius / kCellsPerRadius) {
  assert(radius > 0);
  std::vector<std::pair<uint64_t, int>> order(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    assert(p.allFinite());
    order[i] = {Key(Coordinate(p.x()), Coordinate(p.y()), Coordinate(p.z())), static_cast<int>(i)};
  }
  std::sort(order.begin(), order.end());
  points_.reserve(points.size());
  indices_.reserve(points.size());
  for (const auto& [key, index] : order) {
    const uint64_t column = key / kCellsPerAxis;
    if (columns_.empty() || columns_.back().key != column) {
      columns_.push_back({column, static_cast<int>(cells_.size())});
    }
    if (cells_.empty() || cells_.back().key != key) {
      cells_.push_back({key, static_cast<int>(indices_.size())});
    }
    indices_.push_back(index);
    points_.push_back(points[index]);
  }
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
