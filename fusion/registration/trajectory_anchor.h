#pragma once

#include <vector>

#include "fusion/registration/pose_correction.h"

namespace curvefusion {

/// The motion of the world that best takes corrected poses, which are right among one another, to
/// the given ones: corrected[i] is the corrected pose (T_world_camera) of frame indices[i]
/// (ascending), given those of all frames. `sigmas` are the standard deviations of each corrected
/// pose, along and about the axes of its camera. The error of a given pose is zero at the first
/// frame and a random walk from there on (as that of ORB-SLAM2 at 30 Hz), so early frames say where
/// the world is. This is the generalised least squares estimate for that model. The identity where
/// there are no frames.
RigidTransform AnchorToGivenPoses(const std::vector<RigidTransform>& given,
                                  const std::vector<int>& indices,
                                  const std::vector<RigidTransform>& corrected,
                                  const std::vector<SmallMotion>& sigmas);

}  // namespace curvefusion
