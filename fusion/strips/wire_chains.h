#pragma once

#include <map>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Which edges are pieces of one wire: at every node the straightest pairs of ends (each end in one
/// pair) that turn by less than 25 degrees within 10 mm on either side go on into one another. An
/// edge that turns by more than 60 degrees within so much is of two wires and goes on nowhere. The
/// number of its wire for each edge; numbers ascend with the least edge of a wire.
std::map<EdgeId, int> WiresOfEdges(const SkeletonGraph& skeleton);

}  // namespace curvefusion
