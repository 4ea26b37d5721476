#include "fusion/solid_parts/winding_number.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "kernel/solid_angle.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// In radii of a group. Chosen: farther away the dipole is off by some percent of its share (Barill
// et al. 2018).
constexpr double kFar = 2.5;

}  // namespace

WindingNumber::WindingNumber(const TriangleMesh& mesh, double cell_size) : mesh_(mesh) {
  std::map<VoxelKey, Group> by_cell;
  for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
    const auto [a, b, c] = CornersOf(mesh_, i);
    const Vec3 center = (a + b + c) / 3;
    const Vec3 area = (b - a).cross(c - a) / 2;
    Group& group = by_cell[VoxelOf(center, cell_size)];
    group.triangles.push_back(i);
    group.center += area.norm() * center;
    group.dipole += area;
    group.area += area.norm();
  }
  for (auto& [cell, group] : by_cell) {
    if (group.area <= 0) continue;
    group.center /= group.area;
    for (const size_t i : group.triangles) {
      for (const Vec3& p : CornersOf(mesh_, i)) {
        group.radius = std::max(group.radius, (p - group.center).norm());
      }
    }
    groups_.push_back(std::move(group));
  }
}

double WindingNumber::At(const Vec3& p) const {
  double angle = 0;
  for (const Group& group : groups_) {
    const Vec3 offset = group.center - p;
    const double distance = offset.norm();
    if (distance > kFar * group.radius) {
      angle += group.dipole.dot(offset) / (distance * distance * distance);
      continue;
    }
    for (const size_t i : group.triangles) {
      const auto [a, b, c] = CornersOf(mesh_, i);
      angle += SolidAngle(a - p, b - p, c - p);
    }
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace curvefusion
