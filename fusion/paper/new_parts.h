#pragma once

#include <vector>

#include "fusion/paper/curve_overlap.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// How the parts that only a bundle has are attached to the partial skeleton.
struct AttachmentDistances {
  double overlap = 0;   ///< curves nearer than this overlap, metres
  double junction = 0;  ///< attachments nearer than this to a junction go to the junction
  double end = 0;       ///< attachments nearer than this to a free end go to the end
};

/// Adds to `partial` what `bundle` has beyond it: the stretches of bundle edges that match nothing.
/// Their ends are attached where the curve next to them matches; a junction of the bundle that
/// matches the inside of a curve splits that curve ("if a junction point exists in the overlapping
/// region, we split the curve segment that crosses the junction"); a junction near one of the
/// partial skeleton becomes one with it. Stubs and detours that never leave the overlap distance
/// are not added. `matches` are those of `bundle` in `partial`, whose points may have moved since
/// but not changed in number. CurveFusion 4.3 (ii).
void AddNewParts(SkeletonGraph& partial, const SkeletonGraph& bundle,
                 const std::vector<std::vector<Match>>& matches,
                 const AttachmentDistances& distances);

}  // namespace curvefusion
