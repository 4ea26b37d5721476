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

  /// Adds edges behind those that are there. There is room for kRoom of the points first added
  /// (chosen).
  static constexpr double kRoom = 0.25;
  void Append(const SkeletonGraph& graph, const std::vector<EdgeId>& added);

  struct Curve {
    EdgeId edge;
    int version;  ///< of the edge
    std::array<NodeId, 2> nodes;
    double length;
    double largest_coordinate;
  };
  struct Point {
    Vec3 position;
    double arc_length;  ///< from the front of the curve
  };

  std::vector<Curve> curves;
  std::vector<int> first_points = {0};  ///< of each curve; one more closes the last
  std::vector<Point> points;
  std::vector<int> curve_of;  ///< each point

  int curve_count() const { return static_cast<int>(curves.size()); }
  int point_count() const { return static_cast<int>(points.size()); }
  bool IsSegment(int k) const {
    return k >= 0 && k + 1 < point_count() && curve_of[k] == curve_of[k + 1];
  }
  Segment At(int k) const { return {points[k].position, points[k + 1].position}; }
  int PointCount(int curve) const { return first_points[curve + 1] - first_points[curve]; }
  double Length(int curve) const { return curves[curve].length; }

  /// Arc length of a point of a curve from its front (end 0) or back (end 1).
  double FromEnd(int point, int end) const {
    const double arc_length = points[point].arc_length;
    return end == 0 ? arc_length : Length(curve_of[point]) - arc_length;
  }

  /// The node at which a segment begins (side 0) or ends (side 1); -1 where that is inside a curve.
  NodeId NodeAt(int segment, int side) const;

 private:
  void Reserve(const SkeletonGraph& graph, const std::vector<EdgeId>& added);
};

}  // namespace curvefusion
