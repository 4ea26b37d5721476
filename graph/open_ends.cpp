#include "graph/open_ends.h"

#include <algorithm>

namespace curvefusion {

namespace {

// Chosen: what leaves within this angle of straight on, 46 degrees, continues a branch.
constexpr double kOpenCosine = 0.7;

// The end of an edge at its front or at its back.
OpenEnd MakeEnd(const SkeletonGraph& graph, EdgeId id, bool at_front, const EndPiece& piece) {
  const SkeletonEdge& edge = graph.edge(id);
  Polyline points = edge.points;
  if (!at_front) std::reverse(points.begin(), points.end());
  const std::vector<double> arc_length = CumulativeLength(points);
  const double skipped = std::min(piece.skipped, 0.25 * arc_length.back());
  const Vec3 inward = PointAt(points, arc_length, piece.skipped + piece.length) -
                      PointAt(points, arc_length, skipped);
  const NodeId node = edge.nodes[at_front ? 0 : 1];
  // normalized() leaves zero as it is.
  return {node, id, points.front(), -inward.normalized(), graph.Degree(node) == 1};
}

}  // namespace

std::vector<OpenEnd> EndsAt(const SkeletonGraph& graph, NodeId node, const EndPiece& piece) {
  std::vector<OpenEnd> ends;
  for (const EdgeId id : graph.IncidentEdges(node)) {
    // A self-loop stands there twice.
    const bool is_second = std::any_of(ends.begin(), ends.end(),
                                       [id](const OpenEnd& other) { return other.edge == id; });
    ends.push_back(MakeEnd(graph, id, graph.edge(id).nodes[0] == node && !is_second, piece));
  }
  return ends;
}

std::vector<OpenEnd> OpenEnds(const SkeletonGraph& graph, const EndPiece& piece) {
  std::vector<OpenEnd> open;
  for (const NodeId node : graph.Nodes()) {
    const std::vector<OpenEnd> branches = EndsAt(graph, node, piece);
    for (const OpenEnd& branch : branches) {
      const bool goes_on = std::any_of(branches.begin(), branches.end(), [&](const OpenEnd& next) {
        return -next.outward.dot(branch.outward) > kOpenCosine;
      });
      if (!goes_on) open.push_back(branch);
    }
  }
  return open;
}

OpenEnd FreeEnd(const SkeletonGraph& graph, NodeId node, const EndPiece& piece) {
  return EndsAt(graph, node, piece).front();
}

}  // namespace curvefusion
