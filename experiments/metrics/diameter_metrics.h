#pragma once

#include <optional>
#include <vector>

#include "experiments/metrics/curve_metrics.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A result's edge: means along its length, in metres.
struct EdgeDiameter {
  EdgeId edge = 0;
  double length = 0;         ///< of the part that was compared
  double diameter = 0;       ///< of the result
  double true_diameter = 0;  ///< of the nearest true curves
};

/// How well diameters were measured, over all points of the result that have a diameter and lie
/// within 10 mm of a true curve (farther ones are false curves and have no true diameter).
struct DiameterScores {
  std::optional<double> mean_error;      ///< mean of |result - truth|, metres
  std::optional<double> relative_error;  ///< mean of |result - truth| / truth
  double compared_share = 0;             ///< which part of the result that is
  std::vector<EdgeDiameter> edges;       ///< those with a compared part, ascending
};

/// Compares samples of an aligned result with those of a truth that has radii everywhere.
DiameterScores CompareDiameters(const SkeletonSamples& result, const SkeletonSamples& truth);

}  // namespace curvefusion
