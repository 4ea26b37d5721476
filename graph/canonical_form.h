#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The same graph with handles, directions of edges and order that depend on its geometry alone, so
/// that two graphs that differ in nothing else have the same canonical form: nodes without edges
/// are left out, nodes at one position become one, nodes and edges are numbered in lexicographic
/// order of their coordinates, from 0 without gaps, and each edge runs in the direction that comes
/// first in that order. O(n log n) in points. A graph that is given up need not be copied.
SkeletonGraph CanonicalForm(const SkeletonGraph& graph);
SkeletonGraph CanonicalForm(SkeletonGraph&& graph);

}  // namespace curvefusion
