#pragma once

#include "fusion/volume/block_allocation.h"
#include "fusion/volume/integration_frame.h"
#include "fusion/volume/voxel_blocks.h"

namespace curvefusion {

/// Adds the frame to the running mean (Curless and Levoy 1996) of every voxel of the grid that lies
/// less than the truncation behind a measurement; far in front of it counts as +1, so that what
/// moved or flew is carved away. Distances run along the optical axis.
void UpdateBlocks(const IntegrationFrame& frame, const TsdfScale& scale, int max_weight,
                  VoxelBlockGrid& grid);

}  // namespace curvefusion
