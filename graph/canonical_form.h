#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The same graph with handles, directions of edges and order that depend on its geometry alone, so
/// that two graphs that differ in nothing else have the same canonical form: nodes without edges
/// are left out, nodes at one position become one and are numbered in the order of their positions
/// (kernel/morton_order.h), in which neighbours in space mostly lie near each other in memory,
/// edges in the order of their nodes and between those by their coordinates, from 0 without gaps,
/// and each edge runs in the direction that comes first. O(n log n) in points. A graph that is
/// given up need not be copied.
SkeletonGraph CanonicalForm(const SkeletonGraph& graph);
SkeletonGraph CanonicalForm(SkeletonGraph&& graph);

}  // namespace curvefusion
