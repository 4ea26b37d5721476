#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/paper/surface_removal.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// CurveFusion 4.3 "Wire radius estimation".
struct WireRadiusOptions {
  /// Metres, 0.0005 to 0.1. "We sample a set of points from the skeleton": no number; chosen.
  double sample_step = 5 * kMillimetre;
  /// Pixels, 4 to 128. "We then inspect a 16 x 16 box".
  int box_size_px = 16;
  /// Metres, 0.00001 to 0.01. "Clustered based on a histogram": no number; chosen: below the
  /// paper's own errors (its Table 1).
  double histogram_bin = 0.2 * kMillimetre;
};
void VisitOptions(WireRadiusOptions& options, OptionVisitor& visitor);

/// The diameters, metres, of all boxes that are accepted: sample points of a bundle's skeleton
/// (world frame) are projected into the colour images of that bundle's frames; a box around one
/// counts where it holds exactly one strip. The paper converts the most prominent value from pixels
/// to metres; here each box is converted with its own depth, because the camera's distance varies.
/// Throws Error(kBadInput) for images that cannot be read.
std::vector<double> MeasureDiameters(const SkeletonGraph& bundle_skeleton, const Sequence& sequence,
                                     const BundleFrames& frames, const WireRadiusOptions& options);

/// "The most prominent value is chosen": half of it for every vertex; nothing without diameters.
/// Returns the radius, 0 for none.
double AssignProminentRadius(const std::vector<double>& diameters, const WireRadiusOptions& options,
                             SkeletonGraph& skeleton);

}  // namespace curvefusion
