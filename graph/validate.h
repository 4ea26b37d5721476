#pragma once

#include <string>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What is wrong with an edge of a graph, or with one that is to be added to it ("points[3] repeats
/// the point before it"): fewer than two points, points not within kMaxComputable
/// (kernel/bounds.h), segments of length zero, ends that do not equal the nodes bit for bit, radii
/// that are not positive, observations that are negative, either not one per point or none. Of each
/// kind the first. Its nodes must exist.
std::vector<std::string> EdgeFaults(const SkeletonEdge& edge, const SkeletonGraph& graph);

/// What is wrong with a graph whatever the distance of its edges, one sentence each: nodes that are
/// not within kMaxComputable, and EdgeFaults. Every operation on graphs without faults ends in one
/// without. Linear.
std::vector<std::string> Faults(const SkeletonGraph& graph);

/// How near curves of a result may come without meeting, metres. Chosen: half the distance of the
/// axes of two wires of 2 mm (CurveFusion 4, assumption iv) that touch.
inline constexpr double kProximity = 1 * kMillimetre;

/// What is wrong with a graph, one sentence each; empty for a valid one:
/// - it has no Faults;
/// - no two edges come within `proximity` of each other except at a shared node, no edge comes
///   within it of itself except between places less than kConnectedReach times `proximity` apart
///   along it that have no point in common (FindContacts in graph/contacts.h);
/// - no edge is there twice: two edges between the same nodes that are one curve to within
///   `proximity` (graph/parallel_edges.h).
/// Exact decisions; O(n log n) in segments for graphs that are nearly valid.
std::vector<std::string> Violations(const SkeletonGraph& graph, double proximity);

/// Throws Error(kBadInput) with the first violations and their number where there are any.
/// `subject` says what was validated ("skeleton.json", "the fused skeleton").
void Validate(const SkeletonGraph& graph, double proximity, const std::string& subject);

/// Throws Error(kBadInput) where a point of a curve is not within kMaxComputable (kernel/bounds.h):
/// geometric steps cannot start from that.
void RequireComputable(const SkeletonGraph& graph, const std::string& subject);

/// Throws Error(kBadInput) where a node, a point or a radius of a file exceeds kMaxCoordinate
/// (kernel/bounds.h).
void RequireWithinBounds(const SkeletonGraph& graph, const std::string& subject);

/// Throws Error(kBadInput) where the curves have more than `limit` metres: what samples them at
/// small steps would fill the memory.
void RequireLength(const SkeletonGraph& graph, double limit, const std::string& subject);

}  // namespace curvefusion
