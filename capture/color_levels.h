#pragma once

#include "kernel/image.h"

namespace curvefusion {

struct Sequence;

/// How the colour images of a sequence are stretched before anything looks at them, each channel
/// alike: level v becomes 128 + gain * (v - middle), within 0 to 255.
struct ColorLevels {
  double gain = 1;  ///< 1: the images stay as stored
  double middle = 128;
};

/// Levels that give the images of a sequence the range of those for which the program was made,
/// where theirs is smaller, as of dark images and through haze; as far as their noise and the steps
/// of 8 bits allow. From a few frames; images that cannot be read are left out.
ColorLevels MeasureColorLevels(const Sequence& sequence);

/// Nothing changes with a gain of 1.
void ApplyLevels(const ColorLevels& levels, ColorImage& image);

}  // namespace curvefusion
