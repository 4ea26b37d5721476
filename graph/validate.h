#pragma once

#include <string>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What is wrong with a graph, one sentence each; empty for a valid one:
/// - all coordinates are finite, the ends of an edge equal its nodes bit for bit, no segment has
///   length zero, radii are positive, observations not negative, both one per point or none;
/// - no two edges come within `proximity` of each other except at a shared node, no edge comes
///   within it of itself except where it is continuous (FindContacts says what that means);
/// - no edge is there twice: two edges between the same nodes, each within `proximity` of the
///   other.
/// Exact decisions; O(n log n) in segments for graphs that are nearly valid.
std::vector<std::string> Violations(const SkeletonGraph& graph, double proximity);

/// Throws Error(kBadInput) with the first violations and their number where there are any.
/// `subject` says what was validated ("skeleton.json", "the fused skeleton").
void Validate(const SkeletonGraph& graph, double proximity, const std::string& subject);

}  // namespace curvefusion
