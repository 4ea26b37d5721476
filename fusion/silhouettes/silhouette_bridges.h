#pragma once

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What ends may be joined through the silhouettes of wires.
struct SilhouetteBridgeOptions {
  double max_length = 0.2;  ///< metres
  double min_share = 0.9;   ///< of the images that must show each place as wire
};

/// Joins ends that nothing continues and that face each other (OpenEnds) where a path between them
/// is seen as wire and does not run along another edge. Bridges have the radii of the edges they
/// continue, which need some. Returns how many there are.
int BridgeOpenEnds(const WireSilhouettes& silhouettes, const SilhouetteBridgeOptions& options,
                   SkeletonGraph& skeleton);

/// Joins free ends to the first of the curves that lie ahead of them, through places that are seen
/// as wire. Returns how many were joined.
int JoinEndsToSides(const WireSilhouettes& silhouettes, const SilhouetteBridgeOptions& options,
                    SkeletonGraph& skeleton);

}  // namespace curvefusion
