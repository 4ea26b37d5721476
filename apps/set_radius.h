#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Gives every curve of a graph the same radius (metres, > 0), in place of what it had.
void SetRadius(double radius, SkeletonGraph& graph);

}  // namespace curvefusion
