#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/curve_graph/strip_views.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Leaves of curves that colour images propose what they prove. A stretch stays where most images
/// show a strip along it, and either depth shows something farther behind it, or the colours beside
/// it tell that no surface goes on there (ColourLogOdds) and the strips' middles lie near it: depth
/// fills the gaps between close wires. Then every strip speaks for one curve only: that with most
/// evidence is taken first and explains its strips in `views`, and a curve stays only where enough
/// of the others are left to it. `radius` (metres) is that of all curves. Returns the points of
/// curves that are wires even if they hang together with nothing: long ones before free space whose
/// strips' middles lie near them. Throws Error(kBadInput) for an image that cannot be decoded.
std::vector<Vec3> KeepProvenCandidates(const Sequence& sequence, double radius, StripViews& views,
                                       SkeletonGraph& curves);

}  // namespace curvefusion
