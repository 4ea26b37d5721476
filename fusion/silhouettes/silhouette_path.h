#pragma once

#include <optional>

#include "fusion/silhouettes/wire_silhouettes.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// The shortest path from the front of `guide` to its back, no farther than two wires beside it,
/// through places that at least min_share of the images show as wire; then moved to the middle of
/// those places. The ends are kept bit for bit. Nothing where there is none, or only a detour.
/// Costs O(length of the guide x views).
std::optional<Polyline> PathThroughSilhouettes(const WireSilhouettes& silhouettes,
                                               const Polyline& guide, double min_share);

}  // namespace curvefusion
