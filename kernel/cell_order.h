#pragma once

#include <vector>

#include "kernel/voxel_grid.h"

namespace curvefusion {

/// Sorts cells by x, then y, then z. Returns the index that each had, ascending among equal ones. A
/// radix sort: linear.
std::vector<int> SortCells(std::vector<VoxelKey>& cells);

}  // namespace curvefusion
