#pragma once

#include "capture/sequence.h"
#include "capture/trajectory.h"

namespace curvefusion {

/// The pose that the folder of a sequence gives to its first frame; the identity where it gives
/// none.
RigidTransform GivenStart(const Sequence& images);

/// The poses of the frames with their stamps.
Trajectory PosesOf(const Sequence& sequence);

}  // namespace curvefusion
