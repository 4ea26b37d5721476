#pragma once

#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// Iterative closest points (Besl and McKay 1992), CurveFusion 4.3 (i).
struct SkeletonAlignmentOptions {
  /// Metres, 0.0001 to 0.1. "Densely and uniformly distributed sample points": no number; chosen:
  /// the step of the smoothing.
  double sample_step = 1 * kMillimetre;
  /// Metres, 0.0001 to 1. Not in the paper: samples farther than this from the other skeleton pair
  /// with nothing, because a bundle sees curves that the partial skeleton does not have yet, which
  /// would pull it. The paper's own distance within which curves overlap.
  double max_distance = 10 * kMillimetre;
  /// 1 to 1000. The paper gives no end; Besl and McKay stop when the motion does.
  int max_iterations = 100;
};
void VisitOptions(SkeletonAlignmentOptions& options, OptionVisitor& visitor);

/// The rigid motion that takes `source` to `target`: each sample of the source pairs with the
/// nearest sample of the target, the motion that is best in the sense of least squares is applied,
/// and so on until it moves the samples by less than a micrometre. Identity for fewer than three
/// pairs. O(n log n) per iteration.
RigidTransform AlignSkeletons(const SkeletonGraph& source, const SkeletonGraph& target,
                              const SkeletonAlignmentOptions& options);

}  // namespace curvefusion
