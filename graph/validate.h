#pragma once

#include <string>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What is wrong with a graph whatever the distance of its edges, one sentence each: coordinates
/// that are not finite, edges of fewer than two points, edges whose ends do not equal their nodes
/// bit for bit, segments of length zero, radii that are not positive, observations that are
/// negative, either not one per point or none. Every operation on graphs without such faults ends
/// in one without. Linear.
std::vector<std::string> Faults(const SkeletonGraph& graph);

/// What is wrong with a graph, one sentence each; empty for a valid one:
/// - it has no Faults;
/// - no two edges come within `proximity` of each other except at a shared node, no edge comes
///   within it of itself except where it is continuous (FindContacts says what that means);
/// - no edge is there twice: two edges between the same nodes, each within `proximity` of the
///   other.
/// Exact decisions; O(n log n) in segments for graphs that are nearly valid.
std::vector<std::string> Violations(const SkeletonGraph& graph, double proximity);

/// Throws Error(kBadInput) with the first violations and their number where there are any.
/// `subject` says what was validated ("skeleton.json", "the fused skeleton").
void Validate(const SkeletonGraph& graph, double proximity, const std::string& subject);

/// Throws Error(kBadInput) where a coordinate is not finite: geometric steps cannot start from
/// that.
void RequireFinite(const SkeletonGraph& graph, const std::string& subject);

}  // namespace curvefusion
