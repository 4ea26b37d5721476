#pragma once

#include "kernel/image.h"

namespace curvefusion {

/// The medians of squares of SmoothDepth::kSquare pixels of a depth image; 0 where most of a square
/// measured nothing nearer than SmoothDepth::kMaxDepth.
DepthImage SquareMedians(const DepthImage& depth);

/// Depth of the smooth surfaces of a depth image, from planes through 3 x 3 squares.
class SmoothDepth {
 public:
  /// Chosen: pixels of the depth image along a side, and metres, as gaps of 10 mm are two pixels
  /// wide there.
  static constexpr int kSquare = 4;
  static constexpr double kMaxDepth = 3;

  explicit SmoothDepth(const DepthImage& depth);

  /// Of the squares; 0 where there is no smooth surface.
  const DepthImage& squares() const { return smooth_; }

  /// At a pixel of the depth image; 0 where there is no smooth surface.
  float At(int u, int v) const;

 private:
  DepthImage smooth_;
};

}  // namespace curvefusion
