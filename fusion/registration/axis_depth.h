#pragma once

#include <vector>

#include "fusion/strips/strip_samples.h"
#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// A strip's place in the colour image, for which depth is looked up.
struct StripPlace {
  Vec2 pixel;   ///< centre of the strip in the depth image's pixels
  Vec2 normal;  ///< unit
  double half_width_px = 0;
  double clearance_px = 0;  ///< to the nearest other strand
  double depth = 0;         ///< where the wire's axis is expected, along the optical axis, metres
};

/// What a depth image measured of a strip.
struct StripDepth {
  bool measured = false;
  double depth = 0;  ///< mean over the strip's width, metres
  /// Middle of the pixels that belong to the wire, along the normal from the strip's centre, where
  /// the background on both sides could be told from it.
  bool outlined = false;
  double offset_px = 0;
};

/// Looks at the depth pixels across a strip; those within `reach` (metres) of the expected depth
/// belong to the wire.
StripDepth MeasureStripDepth(const DepthImage& depth, const StripPlace& place, double reach);

/// The shift of the colour image against the depth image that explains outlines best: the least
/// squares solution of normal . shift = offset, twice without what is off by more than 2 px. Zero
/// where fewer than 50 outlines (squared cosines of their normals added) determine some direction.
Vec2 EstimateColorShift(const std::vector<Vec2>& normals, const std::vector<double>& offsets_px);

}  // namespace curvefusion
