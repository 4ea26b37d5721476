#pragma once

#include <vector>

#include "graph/contraction/ridge_projection.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// How ridge points are linked into curves. Deviation: CurveFusion 4.2 traces branches during
/// contraction and takes what is left over as junctions.
struct CurveNetworkOptions {
  double max_link = 0.005;
  double min_loop = 0.035;
  double direction_penalty = 2;
  double min_spur = 0.012;
};
void VisitOptions(CurveNetworkOptions& options, OptionVisitor& visitor);

/// Links ridge points by a greedy spanner: links in order of length, those that leave the ridge
/// direction later; a link between points that are connected already only where the path between
/// them is longer than `min_loop`, that is where it closes a loop of the object and not of the
/// noise. Chains of links become edges, points with one or more than two links nodes. A closed
/// chain is one edge from a node to itself. Costs O(n k) for k points within `min_loop`.
SkeletonGraph ConnectRidgePoints(const RidgePoints& ridge, const CurveNetworkOptions& options);

}  // namespace curvefusion
