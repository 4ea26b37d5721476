#pragma once

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Moves junctions that less than min_share of the images show as wire into the wire next to them;
/// RerouteCurves leads their edges there.
void MoveJunctionsIntoWires(const WireSilhouettes& silhouettes, double min_share,
                            SkeletonGraph& skeleton);

/// Removes what images look past: stretches of edges that less than min_share of the images show as
/// wire, with the stubs that remain. Short stretches at junctions stay, since those may lie beside
/// where wires meet, and so do short ones that are missed by little, and bends of long edges that
/// a quarter of the images show; nor does a stretch go of which half is `shown_by_depth` (places,
/// up to 3 mm away). Returns the length removed, metres.
double DropRefutedParts(const WireSilhouettes& silhouettes, double min_share,
                        const std::vector<Vec3>& shown_by_depth, SkeletonGraph& skeleton);

/// Leads stretches of edges that less than min_share of the images show as wire through places near
/// them that as many do, where there is such a way. Needs radii, which become one for each edge
/// that is changed.
void RerouteCurves(const WireSilhouettes& silhouettes, double min_share, SkeletonGraph& skeleton);

}  // namespace curvefusion
