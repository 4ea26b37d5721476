#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// How wide the wires are taken to be, point by point.
struct RidgeScaleOptions {
  double sigma = 0.0035;
  double window = 0.015;
  double quantile = 0.35;
  double sample_spacing = 0.003;
};

/// The rms half width of the cloud across its curves around each query: the second principal
/// spread in a kernel of width `sigma`, with the kernel's own cut-off divided out, and of the
/// values within `window` the `quantile` one, so that junctions, where the spread is large, do not
/// count as thick wires. Infinite values are possible where the cloud is no curve. Costs O(n k) for
/// k points within the kernel.
std::vector<double> LocalThickness(const ObservedPoints& points, const std::vector<Vec3>& queries,
                                   const RidgeScaleOptions& options);

}  // namespace curvefusion
