#pragma once

#include "meshing/dexels.h"

namespace curvefusion {

/// The surface of the union of closed meshes, resampled on a grid: its vertices lie where the edges
/// of the grid leave the union, in each cell triangles of marching cubes (Lorensen, Cline 1987)
/// join them. Closed, oriented and 2-manifold for every input; what is thinner than the spacing,
/// solid or gap, may be lost. It never fails where tubes nearly coincide. Cost: linear in the area
/// over the square of the spacing, a microsecond or two for each unit.
TriangleMesh ResampleUnion(const std::vector<TriangleMesh>& solids, double spacing);

}  // namespace curvefusion
