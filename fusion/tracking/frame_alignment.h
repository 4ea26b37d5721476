#pragma once

#include <vector>

#include "fusion/tracking/frame_pyramid.h"
#include "fusion/tracking/geometric_term.h"
#include "fusion/tracking/model_view.h"
#include "fusion/tracking/photometric_term.h"

namespace curvefusion {

/// The frame before, from which the motion within a frame's time is taken.
struct EarlierPose {
  RigidTransform T_world_camera = RigidTransform::Identity();
  double timestamp = 0;
};

/// The colour camera at the time of the colour image as seen from the depth camera at that of the
/// depth image, for a camera that moves on as it moved since the frame before.
RigidTransform ColorFromDepth(const TrackingFrame& frame, const EarlierPose& earlier,
                              const RigidTransform& T_world_frame,
                              const RigidTransform& T_color_depth);

/// What is known of a frame's pose beforehand, with its standard deviations.
struct PosePrior {
  RigidTransform T_world_camera = RigidTransform::Identity();
  double translation = 0;  ///< metres, in each direction
  double rotation = 0;     ///< radians, about each axis
};

/// Where a frame was found to be and how well.
struct FrameAlignment {
  RigidTransform T_world_camera = RigidTransform::Identity();
  GeometricFit fit;           ///< at the finest level
  double grey_deviation = 0;  ///< grey levels; 0 = no photometric term
  double grey_contrast = 0;   ///< robust deviation of the keyframe's grey
  double cost = 0;            ///< how badly the pose explains the images; compares attempts
  /// Metres: the standard deviation of the least determined motion, where turns count by what they
  /// do at the median depth. Infinite where the equations have no solution.
  double uncertainty = 0;
};

/// Finds the pose of a frame from its distances to the model and its grey differences from a
/// keyframe (may be null), by Gauss-Newton steps from coarse to fine, from the guess that fits best
/// at the coarse levels. `prior` may be null.
FrameAlignment AlignFrame(const TrackingFrame& frame, const ModelView& model,
                          const Keyframe* keyframe, const EarlierPose& earlier,
                          const RigidTransform& T_color_depth,
                          const std::vector<RigidTransform>& T_world_guesses,
                          const PosePrior* prior = nullptr);

}  // namespace curvefusion
