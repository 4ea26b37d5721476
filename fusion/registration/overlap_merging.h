#pragma once

#include <vector>

#include "fusion/registration/overlap.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Weights of a bundle skeleton against the partial skeleton it is merged into.
struct MergeWeights {
  bool by_observation = true;    ///< by the observations stored with the points, else
  double bundle_share = 0.5;     ///< this share for the bundle everywhere: 1 / (i + 1)
  double junction_distance = 0;  ///< junctions nearer than this are averaged as a pair, metres
};

/// Moves the overlapping parts of `partial` to the weighted mean of both skeletons and adds up
/// their observations. Partners are found along arc length: within a run of points matched to one
/// edge, the matches are first made monotone (isotonic regression), so that nearest points cannot
/// zigzag. Pairs of junctions that are each other's nearest are averaged with each other. Beside a
/// moved part the displacement fades over a few times its length. `matches` are those of `bundle`
/// in `partial`; the topology and the point indices of `partial` stay as they are. Both graphs
/// carry observations. CurveFusion 3.3 (ii).
void AverageOverlaps(SkeletonGraph& partial, const SkeletonGraph& bundle,
                     const std::vector<std::vector<Match>>& matches, const MergeWeights& weights);

}  // namespace curvefusion
