#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/curve_graph/strip_views.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Leaves of curves that colour images propose what they prove. A stretch stays where most images
/// show a strip along it and it is rather a wire than not, by how many `places` were found along it
/// (FindColourCandidates), how near the strips' middles lie, and the colours beside it; with
/// nothing farther behind it in depth images, which fill the gaps between close wires, these must
/// tell that no surface goes on there (ColourLogOdds). Then every strip speaks for one curve only:
/// that with most evidence is taken first and explains its strips in `views`, and a curve stays
/// only where enough of the others are left to it. `radius` (metres) is that of all curves. Returns
/// the points of curves that are wires even if they hang together with nothing: long ones before
/// free space whose strips' middles lie near them. Throws Error(kBadInput) for an image that cannot
/// be decoded.
std::vector<Vec3> KeepProvenCandidates(const Sequence& sequence, const std::vector<Vec3>& places,
                                       double radius, StripViews& views, SkeletonGraph& curves);

}  // namespace curvefusion
