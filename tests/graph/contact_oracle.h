#pragma once

#include <vector>

#include "graph/segment_pairs.h"

namespace curvefusion {

/// What SegmentPairsInContact must return, by its definition: every pair of segments, in exact
/// arithmetic throughout, without boxes, filters or shortcuts. Quadratic.
std::vector<SegmentPair> AllPairsInContact(const SkeletonGraph& graph, double threshold);

}  // namespace curvefusion
