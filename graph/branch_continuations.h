#pragma once

#include <vector>

#include "graph/junctions.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A curve that a wire may follow unseen: from the end of a branch on to another curve.
struct BranchContinuation {
  NodeId from = -1;
  EdgeId branch = -1;    ///< what it continues
  Polyline curve;        ///< from the node to where it ends, bit for bit
  NodeId to = -1;        ///< where it ends; -1 for a place inside an edge
  CurveLocation target;  ///< that place
};

/// Where wires may go on that end at a junction on one side of it, or freely: for each such branch
/// the straight path ahead to the first curve that comes near it, or, where that runs on in the
/// same direction from an open end of its own, the smooth curve between both ends. Nothing for
/// branches that reach no curve within 60 mm. Whether a wire is there has to be looked up
/// elsewhere. Of two ends that face each other one continuation is returned. Costs O(n log n) for n
/// points.
std::vector<BranchContinuation> FindContinuations(const SkeletonGraph& graph);

/// A continuation and, as the directions of ends are not exact, the same with the place where it
/// meets the other edge moved along that by up to 9 mm to either side, the least first; those that
/// would leave the edge, or end at a node, are left out.
std::vector<BranchContinuation> WithShifts(const SkeletonGraph& graph,
                                           const BranchContinuation& continuation);

/// Adds continuations as edges with the radius of their branch where that has one: their far ends
/// become nodes of the edges they reach. Handles of split edges become invalid.
void AddContinuations(SkeletonGraph& graph, const std::vector<BranchContinuation>& continuations);

}  // namespace curvefusion
