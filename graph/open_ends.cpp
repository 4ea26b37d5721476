#include "graph/open_ends.h"

#include <algorithm>

namespace curvefusion {

namespace {

constexpr double kOpenCosine = 0.7;

OpenEnd MakeEnd(const SkeletonGraph& graph, NodeId node, EdgeId id, bool at_front,
                double fit_length) {
  Polyline points = graph.edge(id).points;
  if (!at_front) std::reverse(points.begin(), points.end());
  const Vec3 inner = PointAt(points, CumulativeLength(points), fit_length);
  return {node, id, points.front(), (points.front() - inner).normalized(),
          graph.Degree(node) == 1};
}

}  // namespace

std::vector<OpenEnd> OpenEnds(const SkeletonGraph& graph, double fit_length) {
  std::vector<OpenEnd> open;
  for (const NodeId node : graph.Nodes()) {
    std::vector<OpenEnd> branches;
    for (const EdgeId id : graph.IncidentEdges(node)) {
      const SkeletonEdge& edge = graph.edge(id);
      const bool is_loop = edge.nodes[0] == edge.nodes[1];
      const bool is_second =
          is_loop && !branches.empty() && branches.back().edge == id;
      branches.push_back(
          MakeEnd(graph, node, id, is_loop ? !is_second : edge.nodes[0] == node, fit_length));
    }
    for (const OpenEnd& branch : branches) {
      const bool goes_on = std::any_of(branches.begin(), branches.end(), [&](const OpenEnd& next) {
        return -next.outward.dot(branch.outward) > kOpenCosine;
      });
      if (!goes_on) open.push_back(branch);
    }
  }
  return open;
}

OpenEnd FreeEnd(const SkeletonGraph& graph, NodeId node, double fit_length) {
  const EdgeId edge = graph.IncidentEdges(node)[0];
  return MakeEnd(graph, node, edge, graph.edge(edge).nodes[0] == node, fit_length);
}

}  // namespace curvefusion
