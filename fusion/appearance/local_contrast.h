#pragma once

#include "fusion/appearance/wire_posterior.h"
#include "kernel/image.h"

namespace curvefusion {

/// How likely pixels are to show something thin of whatever colour: the farther their colour lies
/// from what is usual around them (the median of a window in which a strip of this width is the
/// smaller part), counted by how far colours lie from it anywhere in the image.
PosteriorImage LocalContrast(const ColorImage& image, double strip_px);

}  // namespace curvefusion
