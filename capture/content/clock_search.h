#pragma once

#include <optional>

#include "capture/content/pose_explanation.h"

namespace curvefusion {

/// Finds the offset of a trajectory whose stamps do not meet those of the images at all: looks for
/// offsets that put both beginnings, or both ends, within two seconds of each other. Decodes about
/// 40 depth images; a second or two. `sequence` must have all images, whatever their poses.
std::optional<PoseSearch> FindDistantClock(const MisfitEvidence& evidence);

}  // namespace curvefusion
