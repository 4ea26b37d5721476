#include "meshing/tube_capsules.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace curvefusion {

double TubeCapsule::Volume() const {
  return std::numbers::pi * radius * radius * ((b - a).norm() + 4.0 / 3 * radius);
}

double TubeCapsule::Distance(const Vec3& p) const {
  return (a + ClosestParameter(a, b, p) * (b - a) - p).norm() - radius;
}

std::vector<TubeCapsule> CapsulesOf(const SkeletonGraph& graph) {
  std::vector<TubeCapsule> capsules;
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    for (size_t i = 0; i + 1 < edge.points.size(); ++i) {
      const double change = std::abs(edge.radii[i + 1] - edge.radii[i]);
      const int parts = 1 + static_cast<int>(50 * change / edge.radii[i]);
      for (int k = 0; k < parts; ++k) {
        const auto at = [&](double t) {
          return edge.points[i] + t * (edge.points[i + 1] - edge.points[i]);
        };
        const double middle = (k + 0.5) / parts;
        capsules.push_back({at(static_cast<double>(k) / parts), at((k + 1.0) / parts),
                            edge.radii[i] + middle * (edge.radii[i + 1] - edge.radii[i])});
      }
    }
  }
  return capsules;
}

CapsuleGrid::CapsuleGrid(std::vector<TubeCapsule> capsules) : capsules_(std::move(capsules)) {
  for (const TubeCapsule& c : capsules_) cell_size_ = std::max(cell_size_, 2 * c.radius);
  for (size_t i = 0; i < capsules_.size(); ++i) {
    const TubeCapsule& c = capsules_[i];
    const Vec3 reach = Vec3::Constant(1.5 * c.radius);
    const Cell low = CellOf(c.a.cwiseMin(c.b) - reach);
    const Cell high = CellOf(c.a.cwiseMax(c.b) + reach);
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) cells_[{x, y, z}].push_back(static_cast<int>(i));
      }
    }
  }
}

const std::vector<int>& CapsuleGrid::Near(const Vec3& p) const {
  static const std::vector<int> none;
  const auto found = cells_.find(CellOf(p));
  return found == cells_.end() ? none : found->second;
}

CapsuleGrid::Cell CapsuleGrid::CellOf(const Vec3& p) const {
  return {static_cast<int>(std::floor(p.x() / cell_size_)),
          static_cast<int>(std::floor(p.y() / cell_size_)),
          static_cast<int>(std::floor(p.z() / cell_size_))};
}

}  // namespace curvefusion
