#pragma once

#include <vector>

#include "meshing/tube_axis.h"

namespace curvefusion {

/// Where an axis passes another tube, or its own after a turn, at about the distance at which tubes
/// touch (within 6 % of the sum of the radii), side by side or crossing: there a small error of the
/// axis decides whether they do. Of each segment of each axis the unit vector towards the other
/// tube (the one nearest to touching), zero elsewhere. Where tubes come together in a node they do
/// so at a slant, which is not meant. Near-linear in segments and pairs that come near each other.
std::vector<std::vector<Vec3>> FindGrazingWays(const std::vector<TubeAxis>& axes);

}  // namespace curvefusion
