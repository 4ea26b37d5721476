#pragma once

#include "capture/sequence.h"
#include "fusion/segmentation/colour_gate.h"
#include "fusion/silhouettes/silhouette_topology.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Removes what the images look past where curves and poses could not be adjusted to them, as in
/// rows of close wires, which have no strips of their own: poses registered to the curves are exact
/// enough for what crosses gaps. `colours` are those learned before. Nothing where the images do
/// not show the curves as wire. Returns the length removed, metres. Throws Error(kBadInput) for an
/// image that cannot be read.
double PruneByColour(const Sequence& sequence, const WireColours& colours,
                     const SilhouetteOptions& options, SkeletonGraph& skeleton);

}  // namespace curvefusion
