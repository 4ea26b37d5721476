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

/// The union of closed meshes without self-intersections, in a tournament of neighbours. Which
/// triangles cross and which parts are inside is decided exactly. Solids in general position are
/// united directly (UniteDirectly), all others by corefinement (CGAL; all constructions exact, too,
/// rounded once at the end). Triangles that no other solid touches are kept as they are. Nothing
/// where the union would not be manifold or a solid turns out to intersect itself. Thread-safe.
std::optional<UnionMesh> UniteSolids(const std::vector<TriangleMesh>& solids);

/// The same for solids in general position alone: many times as fast as where they are not.
std::optional<UnionMesh> UniteSolidsDirectly(const std::vector<TriangleMesh>& solids);

}  // namespace curvefusion
