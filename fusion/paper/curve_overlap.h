#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What a point of one graph corresponds to in another.
struct Match {
  EdgeId edge = -1;      ///< -1: nothing
  double parameter = 0;  ///< index of a point of that edge, with a fraction
  double distance = 0;   ///< metres
  bool is_near = false;  ///< within the distance of some curve, in whatever direction it runs
};

/// Matches every point of every edge of `source` (indexed by edge handle, then point) with the
/// nearest curve of `target` within `distance`: "overlapping curve segments, i.e., curves which are
/// close to each other within a specified distance threshold", CurveFusion 4.3 (ii). Not in the
/// paper: curves whose directions differ by more than 0.6 rad cross instead of overlapping, and a
/// point beyond the end of a curve does not match that curve, as the source goes on there. Both
/// graphs should be sampled evenly at about `step`. O(n log n + k) in points and in pairs of points
/// within the distance.
std::vector<std::vector<Match>> MatchGraphs(const SkeletonGraph& source,
                                            const SkeletonGraph& target, double step,
                                            double distance);

}  // namespace curvefusion
