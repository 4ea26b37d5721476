#include "graph/segment_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {

SegmentTable::SegmentTable(const SkeletonGraph& graph) : SegmentTable(graph, SegmentTable()) {}

SegmentTable::SegmentTable(const SkeletonGraph& graph, const SegmentTable& earlier)
    : edges(graph.Edges()) {
  for (const EdgeId id : edges) versions.push_back(graph.version(id));
  std::vector<int> earlier_numbers(edges.size(), -1);
  const std::vector<int> numbers = NumbersOf(earlier);
  for (size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= 0) earlier_numbers[numbers[i]] = static_cast<int>(i);
  nodes.reserve(edges.size());
  first_points.reserve(edges.size() + 1);
  for (size_t i = 0; i < edges.size(); ++i) {
    if (earlier_numbers[i] >= 0) {
      AddCurve(earlier, earlier_numbers[i]);
    } else {
      AddEdge(graph.edge(edges[i]));
    }
  }
  first_points.push_back(point_count());
}

void SegmentTable::AddEdge(const SkeletonEdge& edge) {
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

void SegmentTable::AddCurve(const SegmentTable& from, int curve) {
  const int first = from.first_points[curve];
  const int last = from.first_points[curve + 1];
  curves.insert(curves.end(), last - first, static_cast<int>(nodes.size()));
  first_points.push_back(point_count());
  nodes.push_back(from.nodes[curve]);
  points.insert(points.end(), from.points.begin() + first, from.points.begin() + last);
  arcs.insert(arcs.end(), from.arcs.begin() + first, from.arcs.begin() + last);
}

std::vector<int> SegmentTable::NumbersOf(const SegmentTable& earlier) const {
  std::vector<int> numbers(earlier.edges.size(), -1);
  size_t here = 0;
  for (size_t i = 0; i < numbers.size(); ++i) {
    while (here < edges.size() && edges[here] < earlier.edges[i]) ++here;
    if (here < edges.size() && edges[here] == earlier.edges[i] &&
        versions[here] == earlier.versions[i])
      numbers[i] = static_cast<int>(here);
  }
  return numbers;
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
