#pragma once

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Parts straight wires that meet at a narrow angle, one behind the other: in depth a sheet hangs
/// between both, through which one curve runs to where they meet, and in the images one hides the
/// other. Where two wires point at one end of a curve from the same side, along ways that no curve
/// follows and all images show as wire, what runs between these ways is removed and both wires are
/// led to that end. Curves that came from beside end freely then, a few millimetres before the
/// wires. Needs radii. Returns how many forks were parted. Costs O(nodes x points).
int PartNarrowForks(const WireSilhouettes& silhouettes, SkeletonGraph& skeleton);

}  // namespace curvefusion
