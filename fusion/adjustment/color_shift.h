#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Where a wire ends in the depth image, beside a strip of the colour image.
struct StripEdge {
  int frame = 0;
  Vec2 normal;           ///< out of the strip, unit
  double beyond_px = 0;  ///< the strip's own edge
};

/// How colour images lie against their depth images.
struct ColorShift {
  Vec2 shift_px = Vec2::Zero();       ///< of all frames: cameras are calibrated to a pixel
  std::vector<Vec2> of_frames_px;     ///< of each besides that: shutters are not in step
  std::vector<Vec2> frame_sigmas_px;  ///< of the latter, standard deviations
};

/// Estimates them from edges of `frame_count` frames: beyond_px = fattening - normal . (shift +
/// shift of the frame), with one unknown fattening for all. Least squares, four times without what
/// is off by more than 2 px (4 px the first time), shrunk towards zero as if shifts were 2 px (of
/// frames .5 px) and edges off by 2 px, of which .2 px are the same for all: in a direction in
/// which few edges look they stay near zero.
ColorShift EstimateColorShift(const std::vector<StripEdge>& edges, int frame_count);

}  // namespace curvefusion
