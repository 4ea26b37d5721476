#pragma once

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Whether min_share of the images show wire on both sides of a curve as well, 8 mm beside it in
/// the plane of the curve and `across`: no image looks past it. False where `across` runs along it.
bool IsInSheet(const WireSilhouettes& silhouettes, double min_share, const Polyline& curve,
               const Vec3& across);

/// Removes short edges between two wires that nothing continues on either side and that are in a
/// sheet: wires seen along their plane cover what is between them in every image, and their depth
/// runs together in places. Returns how many there were.
int DropRungsInSheets(const WireSilhouettes& silhouettes, double min_share,
                      SkeletonGraph& skeleton);

}  // namespace curvefusion
