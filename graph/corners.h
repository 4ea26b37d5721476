#pragma once

#include <cstddef>
#include <optional>

#include "graph/skeleton_graph.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// The vertex at which a curve turns most, where that is by more than `min_turn` (radians) from the
/// 10 mm before it to the 10 mm after it: two wires that meet, drawn as one, rather than a bent
/// rod, which turns by 10 mm over the radius of its bend.
std::optional<size_t> SharpestCorner(const Polyline& points, double min_turn);

/// Makes every such corner of an edge a node.
void SplitAtCorners(SkeletonGraph& graph, double min_turn);

}  // namespace curvefusion
