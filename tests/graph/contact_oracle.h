#pragma once

#include <array>
#include <vector>

#include "graph/segment_pairs.h"

namespace curvefusion {

/// What SegmentPairsInContact must return, by its definition: every pair of segments, in exact
/// arithmetic throughout, without boxes, filters or shortcuts. Quadratic.
std::vector<SegmentPair> AllPairsInContact(const SkeletonGraph& graph, double threshold);

/// Pairs of segments by edge and place on it, which do not depend on the table.
std::vector<std::array<int, 4>> Named(const SegmentTable& table,
                                      const std::vector<SegmentPair>& pairs);

}  // namespace curvefusion
