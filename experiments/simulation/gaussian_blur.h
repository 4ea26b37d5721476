#pragma once

#include "kernel/image.h"

namespace curvefusion {

/// Of an image of `channels` values a pixel; beyond an edge its pixels are repeated. Single
/// multiplications and additions, unlike OpenCV's: the same bits on every machine.
void BlurByGaussian(float* values, int width, int height, int channels, double sigma_px);

/// Of pixels that hold nothing but floats.
template <class Pixel>
void BlurByGaussian(Image<Pixel>& image, double sigma_px) {
  static_assert(sizeof(Pixel) % sizeof(float) == 0);
  BlurByGaussian(reinterpret_cast<float*>(image.data()), image.width(), image.height(),
                 sizeof(Pixel) / sizeof(float), sigma_px);
}

}  // namespace curvefusion
