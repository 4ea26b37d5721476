#include "graph/point_grid.h"

#include <cassert>
#include <utility>

namespace curvefusion {

PointGrid::PointGrid(const std::vector<Vec3>& points, double cell_size) : cell_size_(cell_size) {
  assert(cell_size > 0);
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
    if (cells_.empty() || cells_.back().key != key) {
      cells_.push_back({key, static_cast<int>(indices_.size())});
    }
    indices_.push_back(index);
    points_.push_back(points[index]);
  }
  cells_.push_back({~uint64_t{0}, static_cast<int>(indices_.size())});
}

}  // namespace curvefusion
