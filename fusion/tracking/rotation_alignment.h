#pragma once

#include "fusion/tracking/frame_pyramid.h"

namespace curvefusion {

/// The rotation between two frames by their coarsest grey images alone, as if all they show were
/// far away (Whelan et al. 2016, 3.3.1): a start for the alignment where the camera turns faster
/// than constant velocity foresees. Returns `T_before_now`, or that with its rotation replaced
/// where the images then agree better. Times of the images do not matter: rotations are small.
RigidTransform RotationByGrey(const FrameLevel& before, const FrameLevel& now,
                              const RigidTransform& T_before_now);

}  // namespace curvefusion
