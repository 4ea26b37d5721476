#pragma once

#include <vector>

#include "kernel/image.h"

namespace curvefusion {

/// A pixel at the edge of something that stands before something deeper.
struct DepthEdgePoint {
  int u = 0;
  int v = 0;
  float depth = 0;  ///< metres
  float angle = 0;  ///< of the edge's normal in the image, radians in [0, pi)
};

/// The near side of the depth discontinuities of an image, also across the shadow of a structured
/// light camera (pixels without a measurement). Short pieces, as specks of noise have, are left
/// out; of the others at most `max_points` are returned, evenly picked row by row.
std::vector<DepthEdgePoint> FindDepthEdges(const DepthImage& depth, int max_points);

}  // namespace curvefusion
