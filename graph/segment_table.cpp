#include "graph/segment_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {

double ResolutionAt(double largest_coordinate) {
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
  for (const EdgeId id : added) {
    const SkeletonEdge& edge = graph.edge(id);
    const int curve = curve_count();
    edges.push_back(id);
    versions.push_back(graph.version(id));
    nodes.push_back(edge.nodes);
    double arc = 0;
    for (size_t i = 0; i < edge.points.size(); ++i) {
      if (i > 0) arc += (edge.points[i] - edge.points[i - 1]).norm();
      points.push_back(edge.points[i]);
      arcs.push_back(arc);
      curves.push_back(curve);
    }
    first_points.push_back(point_count());
  }
}

void SegmentTable::Reserve(const SkeletonGraph& graph, const std::vector<EdgeId>& added) {
  if (!edges.empty()) return;
  size_t count = 0;
  for (const EdgeId id : added) count += graph.edge(id).points.size();
  count += static_cast<size_t>(kRoom * static_cast<double>(count));
  points.reserve(count);
  arcs.reserve(count);
  curves.reserve(count);
}

NodeId SegmentTable::NodeAt(int segment, int side) const {
  const int curve = curves[segment];
  if (side == 0) return segment == first_points[curve] ? nodes[curve][0] : -1;
  return segment + 2 == first_points[curve + 1] ? nodes[curve][1] : -1;
}

}  // namespace curvefusion
