#pragma once

#include <vector>

#include "meshing/tube_axis.h"

namespace curvefusion {

/// Which segments of each axis pass another tube, or their own after a turn, at about the distance
/// at which tubes touch (within 6 % of the sum of the radii), side by side or crossing: there a
/// small error of the axis decides whether they do. Where tubes come together in a node they do so
/// at a slant, which is not meant. Near-linear in segments and pairs that come near each other.
std::vector<std::vector<char>> FindGrazingSegments(const std::vector<TubeAxis>& axes);

}  // namespace curvefusion
