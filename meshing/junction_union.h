#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The union of solids before its vertices are rounded to float32.
struct UnionMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// The exact union of closed meshes without self-intersections, by corefinement in a tournament of
/// neighbours (CGAL; all predicates and constructions exact, rounded once at the end). Triangles
/// that no other solid touches are kept as they are. Nothing where the union would not be manifold
/// or a solid turns out to intersect itself. Thread-safe.
std::optional<UnionMesh> UniteSolids(const std::vector<TriangleMesh>& solids);

}  // namespace curvefusion
