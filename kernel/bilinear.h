#pragma once

#include <algorithm>

#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// The colour of an image between pixels, interpolated; outside of it that of its border. The image
/// has two pixels either way at least.
inline Vec3f Bilinear(const ColorImage& image, double u, double v) {
  const int u0 = std::clamp(static_cast<int>(u), 0, image.width() - 2);
  const int v0 = std::clamp(static_cast<int>(v), 0, image.height() - 2);
  const auto a = static_cast<float>(std::clamp(u - u0, 0.0, 1.0));
  const auto b = static_cast<float>(std::clamp(v - v0, 0.0, 1.0));
  const Rgb* top = image.row(v0) + u0;
  const Rgb* bottom = image.row(v0 + 1) + u0;
  Vec3f rgb;
  for (size_t i = 0; i < 3; ++i) {
    const float upper = top[0][i] + a * static_cast<float>(top[1][i] - top[0][i]);
    const float lower = bottom[0][i] + a * static_cast<float>(bottom[1][i] - bottom[0][i]);
    rgb[static_cast<Eigen::Index>(i)] = upper + b * (lower - upper);
  }
  return rgb;
}

}  // namespace curvefusion
