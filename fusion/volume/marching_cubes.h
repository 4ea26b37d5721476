#pragma once

#include "fusion/volume/voxel_blocks.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The zero crossing of the field by marching cubes (Lorensen and Cline 1987) in every cell whose
/// eight corners are observed: vertices shared, triangles counter-clockwise seen from the positive
/// side. Faces with diagonal signs always separate the negative corners, so neighbouring cells
/// agree and the mesh is manifold, closed where the observed region does not end. The order of
/// vertices and triangles depends on the grid only. Cost: linear in blocks.
TriangleMesh MarchingCubes(const VoxelBlockGrid& grid, double voxel_size);

}  // namespace curvefusion
