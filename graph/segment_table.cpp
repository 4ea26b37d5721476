#include "graph/segment_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {

SegmentTable::SegmentTable(const SkeletonGraph& graph) : edges(graph.Edges()) {
  size_t count = 0;
  for (const EdgeId id : edges) count += graph.edge(id).points.size();
  curves.reserve(count);
  points.reserve(count);
  arcs.reserve(count);
  for (const EdgeId id : edges) {
    const SkeletonEdge& edge = graph.edge(id);
    const int curve = static_cast<int>(nodes.size());
    first_points.push_back(point_count());
    nodes.push_back(edge.nodes);
    double arc = 0;
    for (size_t i = 0; i < edge.points.size(); ++i) {
      if (i > 0) arc += (edge.points[i] - edge.points[i - 1]).norm();
      points.push_back(edge.points[i]);
      arcs.push_back(arc);
      curves.push_back(curve);
    }
  }
  first_points.push_back(point_count());
}

double SegmentTable::Resolution() const {
  constexpr double kUlps = 64;
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  if (largest == 0) return 0;
  return std::ldexp(kUlps * std::numeric_limits<double>::epsilon(), std::ilogb(largest));
}

NodeId SegmentTable::NodeAt(int segment, int side) const {
  const int curve = curves[segment];
  if (side == 0) return segment == first_points[curve] ? nodes[curve][0] : -1;
  return segment + 2 == first_points[curve + 1] ? nodes[curve][1] : -1;
}

}  // namespace curvefusion
