#pragma once

#include <vector>

#include "fusion/paper/curve_overlap.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What a bundle skeleton S_(i+1) weighs against the partial skeleton K_i it is merged into.
struct MergeWeights {
  double bundle_weight = 0.5;    ///< 1 / (i + 1)
  double junction_distance = 0;  ///< junctions nearer than this are averaged as a pair, metres
};

/// Moves the overlapping parts of `partial` to the weighted average of both skeletons; the rest
/// stays where it is ("while keeping the original curve segments for the non-overlapping areas"),
/// and smoothing removes the jags between. Pairs of junctions that are each other's nearest are
/// averaged with each other. What the paper leaves open is which points of two overlapping curves
/// are averaged: partners are found along arc length. Within a run of points matched to one edge,
/// the matches are first made monotone (isotonic regression), so that nearest points cannot zigzag.
/// `matches` are those of `bundle` in `partial`; the topology and the point indices of `partial`
/// stay as they are. CurveFusion 4.3 (ii).
void AverageOverlaps(SkeletonGraph& partial, const SkeletonGraph& bundle,
                     const std::vector<std::vector<Match>>& matches, const MergeWeights& weights);

}  // namespace curvefusion
