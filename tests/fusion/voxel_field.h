#pragma once

#include <functional>

#include "fusion/volume/voxel_blocks.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Blocks low .. high (inclusive, along every axis) sampled from a field given in voxels.
inline VoxelBlockGrid SampleField(const std::function<double(const Vec3&)>& field, int low,
                                  int high) {
  VoxelBlockGrid grid;
  for (int z = low; z <= high; ++z) {
    for (int y = low; y <= high; ++y) {
      for (int x = low; x <= high; ++x) {
        const int number = grid.Insert({x, y, z});
        VoxelBlock& block = grid.block(number);
        for (int i = 0; i < kBlockVoxels; ++i) {
          const Vec3 voxel(8 * x + (i & 7), 8 * y + (i >> 3 & 7), 8 * z + (i >> 6));
          block.tsdf[i] = static_cast<float>(field(voxel));
          block.weight[i] = 1;
        }
        grid.SetSigns(number, FindSigns(block));
      }
    }
  }
  return grid;
}

}  // namespace curvefusion
