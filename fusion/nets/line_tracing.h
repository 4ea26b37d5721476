#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

using ImageLine = std::vector<Vec2>;  ///< pixels, one apart

/// Radians from rows, at a point of a line.
double AngleAt(const ImageLine& line, size_t i);

/// The bright lines of an image of mean 0 in which what is usual is 1, each straight on through all
/// that cross it; longer ones than 12 mm. Nothing beyond what is known. `pixel`: metres. 1 s for a
/// million pixels.
std::vector<ImageLine> TraceLines(const Image<float>& image, const MaskImage& known, double pixel);

}  // namespace curvefusion
