#pragma once

#include <optional>
#include <vector>

#include "kernel/triangle_mesh.h"
#include "meshing/junction_union.h"

namespace curvefusion {

/// A place where cleaning must be finer or coarser than elsewhere.
struct CleaningZone {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
  double factor = 1;  ///< on the lengths below
};

/// What makes a union survive the rounding of its vertices to float32.
struct UnionCleaningOptions {
  double min_edge = 0;              ///< m; shorter edges are collapsed
  double min_height = 0;            ///< m; flatter triangles lose their longest or shortest edge
  std::vector<CleaningZone> zones;  ///< the first one that holds the middle of an edge counts
};

/// Rounds a closed union to float32, collapses short edges (link condition, no flipped normals) and
/// flips the longest edge of flat triangles. Vertices at the places of `kept_rings` do not move,
/// and edges between two of one ring stay. Nothing where the union is not an oriented manifold. The
/// result may still intersect itself: check it.
std::optional<TriangleMesh> CleanUnion(const UnionMesh& mesh,
                                       const std::vector<std::vector<Vec3f>>& kept_rings,
                                       const UnionCleaningOptions& options);

}  // namespace curvefusion
