#pragma once

#include "fusion/nets/sheet_views.h"
#include "kernel/image.h"

namespace curvefusion {

/// Where on a sheet wires are rather than gaps, by all images together.
struct SheetImage {
  /// Metres from pixel to pixel; chosen: half a pixel of a Kinect V1 at .6 m.
  static constexpr double kStep = 0.0006;

  Image<float> wire;  ///< times what is usual around: positive on wires; 0 where nothing is known
  MaskImage known;
};

/// A wire has its colour in all images, in a gap each shows another part of what is behind. Colours
/// that go with that tell wires, too. What differs by less than twice the `noise`, grey levels,
/// comes out fainter. `known`: the pixels at which `colours` were looked for.
SheetImage WiresOnSheet(const SheetColours& colours, const MaskImage& known, double noise);

/// Means of what is known, weighted by a Gaussian of so many pixels; 0 far from all of it.
Image<float> MeanAround(const Image<float>& image, const MaskImage& known, double sigma_px);

}  // namespace curvefusion
