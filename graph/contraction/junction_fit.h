#pragma once

#include <utility>
#include <vector>

#include "graph/contraction/junction_refinement.h"
#include "graph/skeleton_graph.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// One end of an edge: side 0 leaves from nodes[0], side 1 from nodes[1].
struct BranchEnd {
  EdgeId edge;
  int side;
};

/// The ends of edges that leave a set of nodes; edges within the set do not.
std::vector<BranchEnd> BranchEnds(const SkeletonGraph& graph, const std::vector<NodeId>& nodes);

/// The first points of a branch in order from its junction, as far as they can matter: `length`,
/// metres.
Polyline NearPoints(const SkeletonGraph& graph, const BranchEnd& end, double length);

/// The stretch of a branch that lies clear of all others: [first, last) of its near points. Where
/// wires part at a small angle it begins far from the junction. It ends before the far node's own
/// blurred zone. `branches` are the near points of all branches, `own` the index of this one.
std::pair<size_t, size_t> ClearStretch(const SkeletonGraph& graph, const BranchEnd& end,
                                       const std::vector<Polyline>& branches, size_t own,
                                       const JunctionRefinementOptions& options);

/// Where the branches of some nodes meet if these are one junction.
struct JunctionFit {
  Vec3 position;
  int lines = 0;            ///< branches clear enough for a line
  double max_residual = 0;  ///< of these, metres; infinite where they meet nowhere near the nodes
  double deviation = 0;  ///< standard deviation of the lines' distances, metres: n lines have 2n -
                         ///< 3 degrees of freedom; infinite where they have none
};

/// Fits lines to the clear stretches of all branches and finds the point nearest to them.
JunctionFit FitJunction(const SkeletonGraph& graph, const std::vector<NodeId>& nodes,
                        const JunctionRefinementOptions& options);

}  // namespace curvefusion
