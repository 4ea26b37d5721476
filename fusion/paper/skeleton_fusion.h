#pragma once

#include "fusion/paper/skeleton_alignment.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// Iterative fusion of bundle skeletons, CurveFusion 4.3.
struct SkeletonFusionOptions {
  SkeletonAlignmentOptions alignment;
  /// Metres, 0.0005 to 0.1. "Close to each other within a specified distance threshold (set to be
  /// 1 cm)".
  double overlap_distance = 10 * kMillimetre;
  /// Metres, 0.0005 to 0.1. Pairs of junctions: "set as 1 cm".
  double junction_distance = 10 * kMillimetre;
  /// Metres, 0.0001 to 0.1. "Intersect (within a proximity threshold)": no number; chosen: below
  /// the thickness of wires.
  double intersection_distance = 3 * kMillimetre;
  /// Metres, 0 to 0.1. "We remove any curve segment shorter than a threshold (2 mm)".
  double min_edge_length = 2 * kMillimetre;
  /// Metres, 0.0001 to 0.1. "A distance of 1 mm between consecutive vertices".
  double step = 1 * kMillimetre;
  /// "Lambda = 60 in our tests".
  double lambda = 60;
};
/// Visits all but `alignment`, which has a section of its own.
void VisitOptions(SkeletonFusionOptions& options, OptionVisitor& visitor);

/// One iteration of the fusion: the partial skeleton K_i of `bundles_so_far` bundles (1 and up) and
/// the skeleton S_(i+1) of the next one, in one frame but for drift, become K_(i+1). Either may be
/// empty; without a partial skeleton ("initially, K_1 is set to be S_1") the bundle's is cleaned
/// and smoothed like the others. The result is valid for `intersection_distance`
/// (graph/validate.h) and sampled at the step. Throws Error(kBadInput) for coordinates that are not
/// finite. Near-linear in points.
SkeletonGraph FuseSkeletons(const SkeletonGraph& partial, const SkeletonGraph& bundle,
                            int bundles_so_far, const SkeletonFusionOptions& options);

}  // namespace curvefusion
