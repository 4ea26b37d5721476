#pragma once

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Removes short edges between two wires that nothing continues on either side, where min_share of
/// the images show wire on both sides of the edge as well: wires seen along their plane cover what
/// is between them in every image, and their depth runs together in places. Returns how many there
/// were.
int DropRungsInSheets(const WireSilhouettes& silhouettes, double min_share,
                      SkeletonGraph& skeleton);

}  // namespace curvefusion
