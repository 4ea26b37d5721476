#pragma once

#include <vector>

#include "fusion/volume/integration_frame.h"
#include "fusion/volume/voxel_blocks.h"

namespace curvefusion {

/// Lengths of a volume, in metres.
struct TsdfScale {
  double voxel_size = 0;
  double truncation = 0;
};

/// Keys of the blocks with a voxel within the truncation of a surface that the grid has not yet,
/// sorted. A surface is where at least four of 4 x 4 pixels measure similar depths; lone pixels
/// allocate nothing. Conservative: a few blocks beside or behind may come along.
std::vector<VoxelKey> FindMissingBlocks(const IntegrationFrame& frame, const TsdfScale& scale,
                                        const VoxelBlockGrid& grid);

}  // namespace curvefusion
