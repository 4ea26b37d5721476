#include "graph/set_radius.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "kernel/error.h"

namespace curvefusion {

namespace {

void SetRadiusOfEdge(EdgeId edge, double radius, SkeletonGraph& graph) {
  const SkeletonEdge curve = graph.edge(edge);
  graph.SetCurve(edge, curve.points, std::vector<double>(curve.points.size(), radius),
                 curve.observations);
}

double MeanRadius(const SkeletonEdge& edge) {
  return std::accumulate(edge.radii.begin(), edge.radii.end(), 0.0) /
         static_cast<double>(edge.radii.size());
}

}  // namespace

void SetRadius(double radius, SkeletonGraph& graph) {
  for (const EdgeId edge : graph.Edges()) SetRadiusOfEdge(edge, radius, graph);
}

void SetMeanRadii(SkeletonGraph& graph) {
  for (const EdgeId edge : graph.Edges()) {
    if (!graph.edge(edge).radii.empty()) {
      SetRadiusOfEdge(edge, MeanRadius(graph.edge(edge)), graph);
    }
  }
}

void SetMedianRadius(SkeletonGraph& graph) {
  std::vector<std::pair<double, double>> radius_and_length;
  double total = 0;
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.radii.empty()) continue;
    radius_and_length.emplace_back(MeanRadius(edge), Length(edge.points));
    total += radius_and_length.back().second;
  }
  if (radius_and_length.empty()) return;
  std::sort(radius_and_length.begin(), radius_and_length.end());
  double below = 0;
  for (const auto& [radius, length] : radius_and_length) {
    below += length;
    if (2 * below < total) continue;
    SetRadius(radius, graph);
    return;
  }
}

void ReduceRadii(const std::string& to, SkeletonGraph& graph) {
  if (to == "vertex") return;
  if (to == "edge") {
    SetMeanRadii(graph);
  } else if (to == "global") {
    SetMedianRadius(graph);
  } else {
    throw Error(ErrorKind::kUsage,
                "there are no radii from " + to + "; name vertex, edge or global");
  }
}

}  // namespace curvefusion
