#pragma once

#include "kernel/image.h"

namespace curvefusion {

/// Which neighbours belong together: values that differ by at most `step + slope * the lesser`.
struct ComponentStep {
  double step = 0;
  double slope = 0;

  bool Joins(float a, float b) const;
};

/// How many pixels the component of each pixel has: pixels above 0, joined with those of their four
/// neighbours that belong to them. 0 for pixels that are not above 0. Takes time in proportion to
/// the pixels, whatever the components.
Image<int> ComponentSizes(const Image<float>& image, const ComponentStep& step);

/// Sets pixels to 0 that lie in components of fewer than `min_pixels` pixels.
void DropSmallComponents(Image<float>& image, int min_pixels, const ComponentStep& step);

}  // namespace curvefusion
