#pragma once

#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/silhouettes/silhouette_bridges.h"
#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// What the silhouettes of the wires decide about their curves. Units, ranges and sources stand in
/// VisitOptions.
struct SilhouetteOptions {
  int max_frames = 60;
  double min_share = 0.7;
  SilhouetteBridgeOptions bridges;
};
void VisitOptions(SilhouetteOptions& options, OptionVisitor& visitor);

/// What has been changed.
struct SilhouetteChanges {
  double removed = 0;  ///< metres of curve
  int continued = 0;   ///< pieces of wire between others, straight ahead of an end
  int bridges = 0;     ///< between ends
  int joins = 0;       ///< of an end to the side of a curve
};

/// Whether the silhouettes tell the wires: most of the skeleton is seen as wire nearly always.
bool TellWires(const WireSilhouettes& silhouettes, const SkeletonGraph& skeleton);

/// Makes the curves agree with the images: where hardly any shows one of the `strips` is dropped,
/// and ends are continued and joined where images show wire ahead of them. A stretch of which half
/// is `shown_by_depth` stays. Needs radii. Deviation: CurveFusion uses colour for ghosts and radii
/// only, but depth shows wires side by side as one, and none at all that run along the line of
/// sight.
SilhouetteChanges CorrectTopology(const WireSilhouettes& silhouettes, const SharesOfCurve& strips,
                                  const SilhouetteOptions& options,
                                  const std::vector<Vec3>& shown_by_depth, SkeletonGraph& skeleton);

}  // namespace curvefusion
