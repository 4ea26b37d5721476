#pragma once

#include <optional>

#include "capture/sequence.h"
#include "fusion/segmentation/colour_gate.h"
#include "fusion/silhouettes/silhouette_topology.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Removes what the images look past where curves and poses could not be adjusted to them, as in
/// arrays of close wires, which have no strips of their own: poses registered to the curves are
/// exact enough for what crosses gaps. `colours` are those learned before. Returns the length
/// removed, metres, or nothing where the images do not show the curves as wire. Throws
/// Error(kBadInput) for an image that cannot be read.
std::optional<double> PruneByColour(const Sequence& sequence, const WireColours& colours,
                                    const SilhouetteOptions& options, SkeletonGraph& skeleton);

}  // namespace curvefusion
