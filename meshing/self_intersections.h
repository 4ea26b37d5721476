#pragma once

#include <utility>
#include <vector>

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// Pairs of triangles (i < j, ascending) that meet anywhere but in the vertices and edges they
/// share by index, decided exactly on the float32 coordinates; a triangle without area is paired
/// with itself. At most about `limit` pairs are returned. Near-linear in triangles and in pairs
/// that come near each other, with O(n log n) for a tree of boxes; in parallel.
std::vector<std::pair<int, int>> FindSelfIntersections(const TriangleMesh& mesh, int limit = 1000);

/// The same for the coordinates as they are, then for those rounded in millimetres, as in files of
/// that unit; a pair may stand there twice. At most about `limit` pairs of each.
std::vector<std::pair<int, int>> FindSelfIntersectionsInFiles(const TriangleMesh& mesh,
                                                              int limit = 1000);

}  // namespace curvefusion
