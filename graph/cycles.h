#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Opens every cycle shorter than `length` by removing one of its edges: the one seen least often,
/// the longest where several were. No wire of a few millimetres can be bent that tightly; such
/// cycles come from spurs that touch a neighbouring branch. Self-loops are cycles of one edge.
/// Bounded searches from edges shorter than `length`: near-linear where few are.
void RemoveSmallCycles(SkeletonGraph& graph, double length);

}  // namespace curvefusion
