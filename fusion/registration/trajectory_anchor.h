#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// How poses err, along and about the axes of the camera. The defaults are those of ORB-SLAM2 at
/// 30 Hz.
struct PoseErrors {
  double translation_step = 0.00033;  ///< drift along an axis from one frame to the next, metres
  double rotation_step = 0.00036;     ///< drift about an axis, radians
  /// What a frame errs by for itself, standard deviations.
  Vec3 translation_jitter = Vec3::Constant(0.0005);
  Vec3 rotation_jitter = Vec3::Constant(0.0005);
};

/// The motion of the world that best takes corrected poses, which are right among one another, to
/// the given ones: corrected[i] is the corrected pose (T_world_camera) of frame indices[i]
/// (ascending), given those of all frames. The error of a given pose is zero at the first frame
/// and a random walk from there on, so early frames say where the world is; but every frame also
/// errs for itself, so the first alone says it badly. This is the generalised least squares
/// estimate for that model. The identity where there are no frames.
RigidTransform AnchorToGivenPoses(const std::vector<RigidTransform>& given,
                                  const std::vector<int>& indices,
                                  const std::vector<RigidTransform>& corrected,
                                  const PoseErrors& errors);

}  // namespace curvefusion
