#pragma once

#include "fusion/tracking/frame_pyramid.h"
#include "fusion/tracking/photometric_term.h"

namespace curvefusion {

/// Where a frame was taken from by grey differences from a keyframe alone, in Gauss-Newton steps
/// from coarse to fine from a pose that is a few pixels off. Depth of the frame is not needed.
struct ViewAlignment {
  RigidTransform T_world_camera = RigidTransform::Identity();
  double deviation = 0;  ///< grey levels, robust, at the finest level; infinite where too little of
                         ///< the keyframe is seen
};
ViewAlignment AlignToKeyframe(const Keyframe& keyframe, const TrackingFrame& frame,
                              const RigidTransform& T_world_guess,
                              const RigidTransform& T_color_depth);

}  // namespace curvefusion
