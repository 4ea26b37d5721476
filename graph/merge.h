#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Shrinks edges between two different nodes to one node each, at the mean of both weighted by
/// degree; of edges that share a node only the first.
void ContractEdges(SkeletonGraph& graph, const std::vector<EdgeId>& edges);

/// Removes edges shorter than `length`, shortest first: dangling and isolated ones and self-loops
/// disappear, links between junctions shrink to one junction. Nodes of degree 2 are dissolved
/// before and after. CurveFusion 4.3: "we remove any curve segment shorter than a threshold".
void RemoveShortEdges(SkeletonGraph& graph, double length);

/// Removes dangling edges shorter than `length` that end at a junction, shortest first; edges that
/// have become one curve count as one. Isolated curves stay.
void PruneSpurs(SkeletonGraph& graph, double length);

/// Removes self-loops up to a length, of those that changed after a version, and nodes that are
/// left without edges.
void RemoveSmallLoops(SkeletonGraph& graph, double length, int since = 0);

}  // namespace curvefusion
