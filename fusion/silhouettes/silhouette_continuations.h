#pragma once

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Continues wires that end at another on one side of it, or freely, to the next curve ahead
/// (FindContinuations), straight through places that at least `min_share` of the images show as
/// wire, but not into the side of a wire where the images show all around as wire (IsInSheet); what
/// was added is continued in turn. Wires along the line of sight, which depth loses
/// between those that cross them, come back so. Needs radii. Returns how many pieces were added.
int ContinueWires(const WireSilhouettes& silhouettes, double min_share, SkeletonGraph& skeleton);

}  // namespace curvefusion
