#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The connected piece of a result that explains most of the truth: with the greatest length of
/// true curve within kCurveReach of it; of equal ones, and where none explains anything, the
/// longest. Not simply the longest one, as false curves along the edges of a table may be longer
/// than the object. Handles are the result's. Empty for an empty result. O(n log n) in samples.
SkeletonGraph MainPiece(const SkeletonGraph& result, const SkeletonGraph& truth);

}  // namespace curvefusion
