#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// When parts of two skeletons count as the same curve.
struct OverlapCriteria {
  double distance = 10 * kMillimetre;   ///< nearer than this
  double max_angle = 0.6;               ///< and running in directions less than this apart
  bool keep_neighbours = true;          ///< and no other part of the graph fits clearly better
  double separation = 3 * kMillimetre;  ///< "clearly": nearer by this
};

/// What a point of one graph corresponds to in another.
struct Match {
  EdgeId edge = -1;      ///< -1: nothing
  double parameter = 0;  ///< index of a point of that edge, with a fraction
  double distance = 0;   ///< metres
  bool is_near = false;  ///< within the distance of some curve, in whatever direction it runs
};

/// Matches every point of every edge of `source` (indexed by edge handle, then point) with the
/// nearest curve of `target` that meets the criteria. A point beyond the end of a
/// curve does not match that curve: there the source goes on. With keep_neighbours a point matches
/// nothing where its counterpart is clearly nearer to some other part of `source`, one that is not
/// close by along the graph: a second wire beside the first is a wire of its own. Both graphs
/// should be sampled evenly at about `step`. O(n log n + k) in points and in pairs of points within
/// the distance.
std::vector<std::vector<Match>> MatchGraphs(const SkeletonGraph& source,
                                            const SkeletonGraph& target, double step,
                                            const OverlapCriteria& criteria);

}  // namespace curvefusion
