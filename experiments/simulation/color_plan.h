#pragma once

#include <cstdint>
#include <vector>

#include "experiments/simulation/color_camera.h"
#include "experiments/simulation/color_image.h"

namespace curvefusion {

/// How the colour images of a scan are taken, and what is told of their camera.
struct ColorPlan {
  ColorCameraOptions camera;
  RigidTransform T_depth_color = RigidTransform::Identity();
  PinholeCamera told_camera;
  RigidTransform T_told_color_depth = RigidTransform::Identity();
  /// Whether the calibration errs, by a shift of the images that also changes from frame to frame.
  bool shifts = true;
  std::vector<Vec3> gains;  ///< of red, green and blue, by frame
};

/// The plan for a scan; `registered_camera` has the depth camera's place and shape in pixels of
/// colour, `large` doubles the resolution.
ColorPlan PlanColor(const ColorOptions& options, const PinholeCamera& registered_camera, bool large,
                    int frames, double frame_rate, uint64_t seed);

}  // namespace curvefusion
