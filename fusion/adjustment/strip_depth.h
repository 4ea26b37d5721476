#pragma once

#include <array>

#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// A strip's place in the colour image, for which depth is looked up.
struct StripPlace {
  Vec2 pixel;   ///< centre of the strip in the depth image's pixels
  Vec2 normal;  ///< unit
  double half_width_px = 0;
  double depth = 0;  ///< where the wire's axis is expected, along the optical axis, metres
};

/// Where a wire ends in the depth image, on one side of its strip.
struct DepthEdge {
  bool found = false;
  double distance_px = 0;  ///< from the strip's centre
};

/// What a depth image measured of a strip.
struct StripDepth {
  bool measured = false;
  double depth = 0;                ///< mean over the strip's width, metres
  std::array<DepthEdge, 2> edges;  ///< against the normal, and along it
};

/// Looks at the depth pixels across a strip; those within `reach` (metres) of the expected depth
/// belong to the wire. An edge is found where the pixels end within 7 px of the strip's own edge,
/// and nothing else as near begins within 5 px of that.
StripDepth MeasureStripDepth(const DepthImage& depth, const StripPlace& place, double reach);

}  // namespace curvefusion
