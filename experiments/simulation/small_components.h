#pragma once

#include "kernel/image.h"

namespace curvefusion {

/// Sets pixels to 0 that lie in components of fewer than `min_pixels`: pixels above 0, joined with
/// those of their four neighbours whose values differ by at most `max_step`. Takes time in
/// proportion to the pixels, whatever the components.
void DropSmallComponents(Image<float>& image, int min_pixels, double max_step);

}  // namespace curvefusion
