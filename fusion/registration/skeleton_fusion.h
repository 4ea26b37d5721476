#pragma once

#include "fusion/registration/alignment.h"
#include "graph/skeleton_graph.h"
#include "graph/smoothing.h"
#include "kernel/options.h"

namespace curvefusion {

/// Iterative fusion of bundle skeletons, CurveFusion 3.3.
struct SkeletonFusionOptions {
  bool align = true;
  bool move_partial = false;
  double min_inlier_fraction = 0.3;
  double max_rotation = 0.2;
  double overlap_distance = 10 * kMillimetre;
  double max_overlap_angle = 0.6;
  bool keep_neighbours = true;
  bool weights_by_observation = true;
  double junction_distance = 10 * kMillimetre;
  double intersection_distance = 3 * kMillimetre;
  double min_edge_length = 2 * kMillimetre;
  double min_cycle_length = 20 * kMillimetre;
  AlignmentOptions alignment;
  SmoothingOptions smoothing;
};
/// Visits all but `alignment` and `smoothing`, which have sections of their own.
void VisitOptions(SkeletonFusionOptions& options, OptionVisitor& visitor);

/// The options as the paper has them.
SkeletonFusionOptions PaperSkeletonFusionOptions();

/// One iteration of the fusion: the partial skeleton of `bundles_so_far` bundles (1 and up) and the
/// skeleton of the next one, in one frame but for drift, become the next partial skeleton. Either
/// may be empty. The result is valid for `intersection_distance` (graph/validate.h), sampled at the
/// smoothing step, and carries observations: bundles, or whatever unit the inputs carry; inputs
/// without count as bundles_so_far and 1. Where `alignment` is given it receives how the bundle was
/// aligned to the partial skeleton; with no trustworthy alignment nothing is moved. The first
/// bundle is cleaned and smoothed like the others. Throws Error(kBadInput) for coordinates that are
/// not finite. Near-linear in points.
SkeletonGraph FuseSkeletons(const SkeletonGraph& partial, const SkeletonGraph& bundle,
                            int bundles_so_far, const SkeletonFusionOptions& options,
                            AlignmentResult* alignment = nullptr);

}  // namespace curvefusion
