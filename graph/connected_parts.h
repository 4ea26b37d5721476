#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Removes loops shorter than `min_length` that hang at a junction, and of two edges between the
/// same nodes that enclose so short a loop the longer one. Closed curves without a junction stay.
void DropShortLoops(SkeletonGraph& graph, double min_length);

/// The edges of each connected part of the graph, parts by their lowest edge.
std::vector<std::vector<EdgeId>> ConnectedEdges(const SkeletonGraph& graph);

/// Removes components whose edges are together shorter than `min_length`.
void DropSmallComponents(SkeletonGraph& graph, double min_length);

}  // namespace curvefusion
