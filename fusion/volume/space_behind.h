#pragma once

#include "fusion/volume/block_allocation.h"
#include "fusion/volume/voxel_blocks.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// How solid it is `distance` metres of depth behind each pixel of a rendering, along its ray: the
/// mean distance stored there over the one behind a surface that no frame saw through. 1 = solid, 0
/// and less = mostly seen through, NaN where nothing was rendered or that place never observed.
/// `distance` must be less than the truncation. Cost: a hash look-up a pixel.
DepthImage SolidityBehind(const VoxelBlockGrid& grid, const TsdfScale& scale,
                          const DepthImage& rendering, const PinholeCamera& camera,
                          const RigidTransform& T_world_camera, double distance);

}  // namespace curvefusion
