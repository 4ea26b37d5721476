#pragma once

#include <vector>

#include "experiments/simulation/depth_sensor.h"

namespace curvefusion {

/// The colour camera. Blur and noise are those of a webcam: own choice.
struct ColorCameraOptions {
  PinholeCamera camera{640, 480, 580, 580, 319.5, 239.5};
  double blur_sigma_px = 0.6;
  double noise_sigma = 3;  ///< of the raw mosaic, in 1/255
  double vignetting = 0;   ///< share of the light that is missing in the corners
};

/// How one picture is taken.
struct ColorShot {
  /// Where the camera is at moments of the exposure: 1, or 2, 4 or 8 for motion blur. Noise is
  /// drawn from the first one's frame.
  std::vector<Exposure> moments;
  /// Moves the picture, as an error of the calibration between depth and colour does.
  Vec2 shift_px = Vec2::Zero();
  Vec3 gain = Vec3::Ones();  ///< of red, green and blue: exposure and white balance
};

/// A colour photograph of the scene: 4x4 rays a pixel, shared among the moments, lens blur, Bayer
/// mosaic, noise and demosaicing. Thread-safe.
ColorImage RenderColor(const Scene& scene, const ColorShot& shot, const ColorCameraOptions& options,
                       uint64_t seed);

}  // namespace curvefusion
