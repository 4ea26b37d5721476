#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace curvefusion {

/// All pairs (i < j, ascending) of boxes that overlap or touch, in O(n log^3 n + pairs).
std::vector<std::pair<int, int>> OverlappingBoxes(const std::vector<Eigen::AlignedBox3d>& boxes);

}  // namespace curvefusion
