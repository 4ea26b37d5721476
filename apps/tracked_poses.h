#pragma once

#include <string>

#include "capture/sequence.h"
#include "capture/trajectory.h"

namespace curvefusion {

/// The pose that the folder of a sequence gives to its first frame; the identity where it gives
/// none.
RigidTransform GivenStart(const Sequence& images);

/// The poses of the frames with their stamps.
Trajectory PosesOf(const Sequence& sequence);

/// Why tracked poses cannot be believed: depth images of frames apart disagree. Empty where they
/// agree, or where that cannot be told. About .1 s.
std::string DoubtOfPoses(const Sequence& tracked);

}  // namespace curvefusion
