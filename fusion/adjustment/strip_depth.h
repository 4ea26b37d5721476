#pragma once

#include <array>
#include <optional>

#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// A strip's place in the colour image, for which depth is looked up.
struct StripPlace {
  Vec2 pixel;   ///< centre of the strip in the depth image's pixels
  Vec2 normal;  ///< unit
  double half_width_px = 0;
  double depth = 0;  ///< where the wire's axis is expected, along the optical axis, metres
};

/// What a depth image measured of a strip.
struct StripDepth {
  bool measured = false;
  double depth = 0;  ///< mean over the strip's width, metres
  /// How far from the strip's centre the wire ends against the normal, and along it, in pixels.
  std::array<std::optional<double>, 2> edges_px;
};

/// Looks at the depth pixels across a strip; those within `reach` (metres) of the expected depth
/// belong to the wire. An edge is found where they end within 7 px of the strip's own edge,
/// and nothing else as near begins within 5 px of that.
StripDepth MeasureStripDepth(const DepthImage& depth, const StripPlace& place, double reach);

}  // namespace curvefusion
