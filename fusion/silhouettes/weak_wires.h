#pragma once

#include "fusion/silhouettes/silhouette_bridges.h"
#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Adds straight wires between two curves that depth shows in places only, because they run along
/// the line of sight: where points lie beside all curves and the images show them as wire, the
/// straight path from curve to curve that passes most of them, if options.min_share of the images
/// show all of it as wire, some of them show it beside all curves, and it is no longer than
/// options.max_length. Nothing where all images look from about the same side, which tells no
/// depth. Needs radii. Returns how many were added. Deviation: in CurveFusion what depth does not
/// hold together is lost.
int AddWeakWires(const WireSilhouettes& silhouettes, const SilhouetteBridgeOptions& options,
                 const ObservedPoints& points, SkeletonGraph& skeleton);

}  // namespace curvefusion
