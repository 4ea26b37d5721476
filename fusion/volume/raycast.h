#pragma once

#include <vector>

#include "fusion/volume/surface_cells.h"
#include "fusion/volume/voxel_blocks.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// Depth along the optical axis (metres, 0 = none) of the first zero crossing from positive to
/// negative along the ray of every pixel. The grid's surface blocks are drawn front to back, and a
/// ray walks only through the cells of blocks that cover its pixel, so empty space costs nothing.
/// The crossing lies on the trilinear interpolant of its cell.
DepthImage RaycastBlocks(const VoxelBlockGrid& grid, const std::vector<SurfaceBlock>& surface,
                         double voxel_size, const PinholeCamera& camera,
                         const RigidTransform& T_world_camera);

}  // namespace curvefusion
