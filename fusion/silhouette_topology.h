#pragma once

#include "fusion/wire_silhouettes.h"
#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// What the silhouettes of the wires decide about their curves. Units, ranges and sources stand in
/// VisitOptions.
struct SilhouetteOptions {
  int max_frames = 60;
  double min_share = 0.7;
  double max_bridge = 0.1;
  double min_bridge_share = 0.9;
};
void VisitOptions(SilhouetteOptions& options, OptionVisitor& visitor);

/// Whether the silhouettes tell the wires: most of the skeleton is seen as wire nearly always.
bool TellWires(const WireSilhouettes& silhouettes, const SkeletonGraph& skeleton);

/// Removes what images look past: stretches of edges that less than min_share of the images show as
/// wire, with the stubs that remain of short edges. Returns the length removed, metres.
double DropRefutedParts(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                        SkeletonGraph& skeleton);

/// Leads stretches of edges that lie beside their wire through places that at least
/// min_bridge_share of the images show as wire, where such a way is near.
void RerouteCurves(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                   SkeletonGraph& skeleton);

/// Joins ends that nothing continues and that face each other (OpenEnds) where all of the curve
/// between them is seen as wire and does not run along another edge. Bridges have the radii of the
/// edges they continue. Returns how many there are.
int BridgeOpenEnds(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                   SkeletonGraph& skeleton);

/// Joins free ends to the curves that lie ahead of them, through places that are seen as wire.
/// Returns how many there are.
int JoinEndsToSides(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                    SkeletonGraph& skeleton);

}  // namespace curvefusion
