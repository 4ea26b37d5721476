#include "apps/page_curves.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "kernel/douglas_peucker.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kFinest = 0.2 * kMillimetre;  // less than a pixel of a screen-filling object
constexpr double kCoarsest = 64 * kFinest;

double RoundedMm(double metres) { return std::round(metres / kMillimetre * 100) / 100; }

std::vector<size_t> NeededPoints(const SkeletonEdge& edge, double tolerance) {
  const Polyline& points = edge.points;
  return DouglasPeucker(points.size(), tolerance, [&](size_t a, size_t k, size_t b) {
    const double t = ClosestParameter(points[a], points[b], points[k]);
    const double off_line = (points[a] + t * (points[b] - points[a]) - points[k]).norm();
    if (edge.radii.empty()) return off_line;
    const double radius = (1 - t) * edge.radii[a] + t * edge.radii[b];
    return std::max(off_line, std::abs(edge.radii[k] - radius));
  });
}

Json RadiiJson(const SkeletonEdge& edge, const std::vector<size_t>& kept) {
  Json radii = Json::array();
  if (edge.radii.empty()) return radii;
  for (const size_t k : kept) radii.push_back(RoundedMm(edge.radii[k]));
  const bool constant = std::all_of(radii.begin(), radii.end(),
                                    [&](const Json& radius) { return radius == radii.front(); });
  return constant ? Json::array({radii.front()}) : radii;
}

void AppendMm(const Vec3& p, Json& numbers) {
  for (int axis = 0; axis < 3; ++axis) numbers.push_back(RoundedMm(p[axis]));
}

size_t PointCount(const SkeletonGraph& graph, double tolerance) {
  size_t count = 0;
  for (const EdgeId edge : graph.Edges()) count += NeededPoints(graph.edge(edge), tolerance).size();
  return count;
}

}  // namespace

Json DrawnCurves(const SkeletonGraph& graph, double tolerance) {
  Json nodes = Json::array();
  std::map<NodeId, size_t> index;
  for (const NodeId node : graph.Nodes()) {
    index[node] = nodes.size();
    Json position = Json::array();
    AppendMm(graph.position(node), position);
    nodes.push_back(position);
  }
  Json edges = Json::array();
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    const std::vector<size_t> kept = NeededPoints(edge, tolerance);
    Json points = Json::array();
    for (const size_t k : kept) AppendMm(edge.points[k], points);
    edges.push_back({{"nodes", {index[edge.nodes[0]], index[edge.nodes[1]]}},
                     {"points", points},
                     {"radii", RadiiJson(edge, kept)}});
  }
  return {{"nodes", nodes}, {"edges", edges}};
}

double DrawingTolerance(const SkeletonGraph& graph, const SkeletonGraph& uncertain,
                        size_t max_points) {
  double tolerance = kFinest;
  while (tolerance < kCoarsest &&
         PointCount(graph, tolerance) + PointCount(uncertain, tolerance) > max_points) {
    tolerance *= 2;
  }
  return tolerance;
}

}  // namespace curvefusion
