#pragma once

#include <limits>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The curve of an edge between two arc lengths from <= to, with radii and observations
/// interpolated. `arc_lengths` is CumulativeLength(edge.points). The nodes of the result are those
/// of the edge and mean nothing. Parts that share a cut share its point bit for bit; at least two
/// points. A vertex of the edge that is no more than `max_splinter` metres and a thousandth of the
/// segment from a cut gives way to it.
SkeletonEdge PartOfEdge(const SkeletonEdge& edge, const std::vector<double>& arc_lengths,
                        double from, double to,
                        double max_splinter = std::numeric_limits<double>::infinity());

/// The point at which parts of an edge are cut at an arc length, bit for bit as PartOfEdge gives
/// it.
Vec3 CutPoint(const SkeletonEdge& edge, const std::vector<double>& arc_lengths, double at);

/// The values of an edge at ascending arc lengths, interpolated. Linear in both.
SkeletonEdge SampledAt(const SkeletonEdge& edge, const std::vector<double>& arc_lengths,
                       const std::vector<double>& at);

/// The curve with points at equal arc-length steps as near to `step` as divides the length evenly,
/// ends kept bit for bit, radii and observations interpolated.
SkeletonEdge Resampled(const SkeletonEdge& edge, double step);

/// Resampled() for every edge of a graph.
void ResampleGraph(SkeletonGraph& graph, double step);

/// Drops points that equal their predecessor; both ends stay. A curve that is one point only keeps
/// two.
void RemoveRepeatedPoints(SkeletonEdge& edge);

/// RemoveRepeatedPoints for every edge that changed after a version; an edge of no length is
/// removed and its nodes become one.
void RemoveZeroLengthSegments(SkeletonGraph& graph, int since = 0);

/// Moves a node and, with it, the near parts of its edges: the displacement fades linearly to zero
/// over `reach` metres of arc length (at most the whole edge), so that no kink is left at the end.
void MoveNodeSmoothly(SkeletonGraph& graph, NodeId node, const Vec3& position, double reach);

/// MoveNodeSmoothly for edges that first get a point at `reach` metres from the node where their
/// segment there goes on for as long again, so that the bend does not reach farther.
void MoveNodeWithBends(SkeletonGraph& graph, NodeId node, const Vec3& position, double reach);

}  // namespace curvefusion
