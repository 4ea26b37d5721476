#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// A small rigid motion: translation (metres), then rotation axis times angle (radians).
using SmallMotion = Eigen::Matrix<double, 6, 1>;
SmallMotion SmallMotionOf(const RigidTransform& T);
RigidTransform RigidTransformOf(const SmallMotion& motion);

/// Poses (T_world_camera) of all frames from those of some: `corrected` holds the poses of the
/// frames `indices` (ascending). What moves each given pose, as seen in the camera's frame, is
/// interpolated linearly for the frames between, and constant beyond the first and the last.
/// Trackers drift slowly: their errors change less from frame to frame than the camera moves.
std::vector<RigidTransform> InterpolateCorrections(const std::vector<RigidTransform>& given,
                                                   const std::vector<int>& indices,
                                                   const std::vector<RigidTransform>& corrected);

}  // namespace curvefusion
