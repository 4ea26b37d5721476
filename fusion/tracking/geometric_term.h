#pragma once

#include "fusion/tracking/frame_pyramid.h"
#include "fusion/tracking/model_view.h"
#include "fusion/tracking/normal_equations.h"

namespace curvefusion {

/// How a frame's depth lies to the model.
struct GeometricFit {
  int measured = 0;      ///< pixels with a depth that were looked at
  int overlapping = 0;   ///< of those whose point falls where the model has a surface near it
  int inliers = 0;       ///< of those as near as three standard deviations
  double deviation = 1;  ///< robust standard deviation of the distances over that of the noise
};

/// Distances of a frame's points from the model's tangent planes (Chen and Medioni 1991), paired by
/// projection, in standard deviations of what sensor and volume give. `T_model_frame` maps the
/// frame's points to the camera of the model's view.
GeometricFit MeasureGeometricFit(const FrameLevel& frame, const ModelLevel& model,
                                 const RigidTransform& T_model_frame);

/// The sums for a small motion (translation, rotation vector, about the model's camera) put before
/// T_model_frame. Distances are weighted by the noise alone, so that a poor start does not weaken
/// them, and by Tukey's function, whose limit grows with `deviation`.
NormalEquations<6> GeometricTerm(const FrameLevel& frame, const ModelLevel& model,
                                 const RigidTransform& T_model_frame, double deviation);

}  // namespace curvefusion
