#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace curvefusion {

/// All pairs (i < j, ascending) of boxes that overlap or touch. By a uniform grid fitted to the
/// boxes: near-linear in boxes and pairs while the boxes are of similar size, as the triangles of a
/// mesh or the segments of tubes are; O(n^2) at worst. Memory O(n + pairs).
std::vector<std::pair<int, int>> OverlappingBoxes(const std::vector<Eigen::AlignedBox3d>& boxes);

}  // namespace curvefusion
