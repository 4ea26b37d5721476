#include "graph/corners.h"

#include <cmath>
#include <vector>

namespace curvefusion {

namespace {

constexpr double kReach = 10 * kMillimetre;  // along the curve to either side; chosen

}  // namespace

std::optional<size_t> SharpestCorner(const Polyline& points, double min_turn) {
  const std::vector<double> arc_lengths = CumulativeLength(points);
  std::optional<size_t> sharpest;
  double least = std::cos(min_turn);
  for (size_t i = 0; i < points.size(); ++i) {
    const double place = arc_lengths[i];
    if (place < kReach || place > arc_lengths.back() - kReach) continue;
    const Vec3 before = points[i] - PointAt(points, arc_lengths, place - kReach);
    const Vec3 after = PointAt(points, arc_lengths, place + kReach) - points[i];
    const double cosine = before.normalized().dot(after.normalized());
    if (cosine >= least) continue;
    least = cosine;
    sharpest = i;
  }
  return sharpest;
}

void SplitAtCorners(SkeletonGraph& graph, double min_turn) {
  std::vector<EdgeId> edges = graph.Edges();
  while (!edges.empty()) {
    const EdgeId edge = edges.back();
    edges.pop_back();
    const std::optional<size_t> corner = SharpestCorner(graph.edge(edge).points, min_turn);
    if (!corner) continue;
    const NodeId node = graph.SplitEdge(edge, *corner);
    for (const EdgeId half : graph.IncidentEdges(node)) edges.push_back(half);
  }
}

}  // namespace curvefusion
