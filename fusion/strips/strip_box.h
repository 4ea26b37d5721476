#pragma once

#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// The strips of a colour image: what lies between two facing edges.
struct StripRegions {
  MaskImage inside;         ///< 1 between the two edges of a strip
  Image<float> axis_width;  ///< width in pixels on the central axis of a strip, 0 elsewhere
};

/// Extracts edges (Canny 1986, on the strongest colour channel) and labels what lies between two
/// parallel edges no more than `max_width_px` apart as a strip, CurveFusion 4.3 ("edge extraction
/// has been applied to each RGB frame to label the images of the wire object as a strip region").
StripRegions LabelStrips(const ColorImage& image, int max_width_px);

/// The mean width in pixels over the central axis of the strip in a square box around a pixel; 0
/// unless the box holds exactly one strip (CurveFusion 4.3).
double StripWidthInBox(const StripRegions& regions, const Vec2& center, int box_size_px);

}  // namespace curvefusion
