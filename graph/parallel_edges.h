#pragma once

#include <utility>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Pairs of edges between the same two nodes that are one curve there twice: they can be followed
/// together from end to end, neither ever turning back, without being farther apart than
/// `distance` (graph/frechet_matching.h), decided exactly.
std::vector<std::pair<EdgeId, EdgeId>> ParallelEdges(const SkeletonGraph& graph, double distance);

/// Replaces parallel edges, pair by pair as long as there are any, by their mean, weighted by
/// observations: of points at the same share of the length or, where these are farther apart than
/// `distance`, of points that go together. It lies within the distance of both but for rounding, or
/// twice that of the second. Observations add up. Only pairs of which an edge changed after a
/// version.
void MergeParallelEdges(SkeletonGraph& graph, double distance, int since = 0);

}  // namespace curvefusion
