#pragma once

#include "kernel/image.h"

namespace curvefusion {

/// By how much to divide an image so that it is about `target` pixels wide; at least 1.
int DivisorForWidth(int width, int target);

/// The mean grey level (of red, green and blue alike) of squares of `divisor` pixels.
Image<float> ShrunkGrey(const ColorImage& image, int divisor);

}  // namespace curvefusion
