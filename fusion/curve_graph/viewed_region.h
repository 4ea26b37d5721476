#pragma once

#include <Eigen/Geometry>

#include "capture/sequence.h"

namespace curvefusion {

/// Where the cameras of a sequence look: the bounds of the space that most of them see, between
/// .1 m before them and where the widest wires are still strips in their images, or, where that is
/// nearer, where the whole path no longer shows depth by parallax. Empty where there are no such
/// places: the camera looks elsewhere in every image. For scans without depth, which would tell
/// where the object is.
Eigen::AlignedBox3d RegionSeenByMost(const Sequence& sequence);

}  // namespace curvefusion
