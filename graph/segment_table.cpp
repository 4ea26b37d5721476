#include "graph/segment_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {

namespace {

// Points of edges are fetched from memory so many edges ahead. Chosen: only the time depends on
// it.
constexpr size_t kLookahead = 8;

}  // namespace

double ResolutionAt(double largest_coordinate) {
  // Chosen: well above the 4 ulps by which places of a common point are apart
  // (docs/graph.md#how-far-resolving-with-threshold-0-moves-points).
  constexpr double kUlps = 64;
  if (largest_coordinate == 0) return 0;
  return std::ldexp(kUlps * std::numeric_limits<double>::epsilon(), std::ilogb(largest_coordinate));
}

double LargestCoordinate(const SkeletonGraph& graph) {
  double largest = 0;
  for (const EdgeId id : graph.Edges())
    for (const Vec3& p : graph.edge(id).points)
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

void SegmentTable::Append(const SkeletonGraph& graph, const std::vector<EdgeId>& added) {
  Reserve(graph, added);
  for (size_t n = 0; n < added.size(); ++n) {
    if (n + kLookahead < added.size()) graph.FetchPoints(added[n + kLookahead]);
    const EdgeId id = added[n];
    const SkeletonEdge& edge = graph.edge(id);
    const int number = curve_count();
    double arc_length = 0;
    double largest = 0;
    for (size_t i = 0; i < edge.points.size(); ++i) {
      const Vec3& p = edge.points[i];
      if (i > 0) arc_length += (p - edge.points[i - 1]).norm();
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
      points.push_back({p, arc_length});
      curve_of.push_back(number);
    }
    curves.push_back({id, graph.version(id), edge.nodes, arc_length, largest});
    first_points.push_back(point_count());
  }
}

void SegmentTable::Reserve(const SkeletonGraph& graph, const std::vector<EdgeId>& added) {
  if (!curves.empty()) return;
  const auto with_room = [](size_t count) {
    return count + static_cast<size_t>(kRoom * static_cast<double>(count));
  };
  size_t count = graph.point_count();
  if (added.size() < static_cast<size_t>(graph.edge_count())) {
    count = 0;
    for (const EdgeId id : added) count += graph.edge(id).points.size();
  }
  points.reserve(with_room(count));
  curve_of.reserve(with_room(count));
  curves.reserve(with_room(added.size()));
  first_points.reserve(with_room(added.size()) + 1);
}

NodeId SegmentTable::NodeAt(int segment, int side) const {
  const int curve = curve_of[segment];
  if (side == 0) return segment == first_points[curve] ? curves[curve].nodes[0] : -1;
  return segment + 2 == first_points[curve + 1] ? curves[curve].nodes[1] : -1;
}

}  // namespace curvefusion
