#pragma once

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Moves junctions that less than min_share of the images show as wire into the wire next to them;
/// RerouteCurves leads their edges there.
void MoveJunctionsIntoWires(const WireSilhouettes& silhouettes, double min_share,
                            SkeletonGraph& skeleton);

/// Leads stretches of edges that less than min_share of the images show as wire through places near
/// them that as many do, where there is such a path. Needs radii, which become one for each edge
/// that is changed.
void RerouteCurves(const WireSilhouettes& silhouettes, double min_share, SkeletonGraph& skeleton);

}  // namespace curvefusion
