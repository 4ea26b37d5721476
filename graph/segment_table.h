#pragma once

#include <array>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/exact.h"

namespace curvefusion {

/// What rounding of coordinates and arc lengths amounts to for a largest coordinate, a power of
/// two: places nearer to each other cannot be told apart, so what is constructed is not finer than
/// this. Decisions do not use it.
double ResolutionAt(double largest_coordinate);

/// The largest absolute value of a coordinate of any edge.
double LargestCoordinate(const SkeletonGraph& graph);

/// The segments of a graph in flat arrays, for passes over all of them. Curves are its edges, those
/// added together in ascending order; segment k runs from point k to point k + 1, so the last point
/// of each curve is the number of no segment.
struct SegmentTable {
  SegmentTable() = default;
  explicit SegmentTable(const SkeletonGraph& graph) { Append(graph, graph.Edges()); }

  /// Of some edges.
  SegmentTable(const SkeletonGraph& graph, const std::vector<EdgeId>& some) { Append(graph, some); }

  /// Adds edges behind those that are there. There is room for kRoom of the points first added.
  static constexpr double kRoom = 0.25;
  void Append(const SkeletonGraph& graph, const std::vector<EdgeId>& added);

  std::vector<EdgeId> edges;                 ///< of each curve
  std::vector<int> versions;                 ///< of each curve: of its edge
  std::vector<std::array<NodeId, 2>> nodes;  ///< of each curve
  std::vector<int> first_points = {0};       ///< of each curve; one more closes the last
  std::vector<int> curves;                   ///< of each point
  std::vector<Vec3> points;
  std::vector<double> arcs;  ///< of each point: arc length from the front of its curve

  int curve_count() const { return static_cast<int>(edges.size()); }
  int point_count() const { return static_cast<int>(points.size()); }
  bool IsSegment(int k) const {
    return k >= 0 && k + 1 < point_count() && curves[k] == curves[k + 1];
  }
  Segment At(int k) const { return {points[k], points[k + 1]}; }
  int PointCount(int curve) const { return first_points[curve + 1] - first_points[curve]; }
  double Length(int curve) const { return arcs[first_points[curve + 1] - 1]; }

  /// Arc length of a point of a curve from its front (end 0) or back (end 1).
  double FromEnd(int point, int end) const {
    return end == 0 ? arcs[point] : Length(curves[point]) - arcs[point];
  }

  /// The node at which a segment begins (side 0) or ends (side 1); -1 where that is inside a curve.
  NodeId NodeAt(int segment, int side) const;

 private:
  void Reserve(const SkeletonGraph& graph, const std::vector<EdgeId>& added);
};

}  // namespace curvefusion
