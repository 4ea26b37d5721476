#pragma once

#include "experiments/simulation/depth_sensor.h"

namespace curvefusion {

/// The colour camera. Blur and noise are those of a webcam: own choice.
struct ColorCameraOptions {
  PinholeCamera camera{640, 480, 580, 580, 319.5, 239.5};
  double blur_sigma_px = 0.6;
  double noise_sigma = 3;  ///< of the raw mosaic, in 1/255
};

/// A colour photograph of the scene: 4x4 rays a pixel, lens blur, Bayer mosaic, noise and
/// demosaicing. `shift_px` moves the picture, as an error of the calibration between depth and
/// colour does. Thread-safe.
ColorImage RenderColor(const Scene& scene, const Exposure& exposure, const Vec2& shift_px,
                       const ColorCameraOptions& options, uint64_t seed);

}  // namespace curvefusion
