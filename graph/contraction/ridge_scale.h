#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// How wide the wires are taken to be, point by point.
struct RidgeScaleOptions {
  double sigma = 0.0035;
  double window = 0.015;
  double quantile = 0.35;
  double sample_spacing = 0.003;
};

/// How many of the `limits` (ascending, metres) the rms half width of the cloud across its curves
/// exceeds around each query. The half width is the second principal spread in a kernel of width
/// `sigma`, with the kernel's own cut-off divided out, and of the values within `window` the
/// `quantile` one, so that junctions, where the spread is large, do not count as thick wires.
/// Where the cloud is no curve it exceeds all limits. Costs O(n k) for k points within the kernel.
std::vector<int> LimitsExceeded(const ObservedPoints& points, const std::vector<Vec3>& queries,
                                const std::vector<double>& limits,
                                const RidgeScaleOptions& options);

}  // namespace curvefusion
