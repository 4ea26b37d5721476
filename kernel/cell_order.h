#pragma once

#include <vector>

#include "kernel/voxel_grid.h"

namespace curvefusion {

/// The indices of cells in ascending order of x, then y, then z; equal ones in ascending order of
/// index. A radix sort over the bits in which the cells differ: linear.
std::vector<int> OrderByCell(const std::vector<VoxelKey>& cells);

}  // namespace curvefusion
