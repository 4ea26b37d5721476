#pragma once

#include <vector>

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The normals to shade a mesh with, as indices per corner of a triangle.
struct CornerNormals {
  std::vector<Vec3f> normals;                 ///< unit vectors
  std::vector<std::array<int, 3>> of_corner;  ///< per triangle, indices into normals
};

/// Normals that are smooth across edges whose triangles turn by less than `crease_angle` (radians)
/// and break at the others, as at the seams where tubes meet. Corners of one vertex that are joined
/// by smooth edges share a normal, the mean of their triangles' by angle, which does not depend on
/// how flat facets are divided; triangles too thin to have a trustworthy normal count less. O(n log
/// n).
CornerNormals ComputeCornerNormals(const TriangleMesh& mesh, double crease_angle);

}  // namespace curvefusion
