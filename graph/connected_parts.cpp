#include "graph/connected_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace curvefusion {

void DropShortLoops(SkeletonGraph& graph, double min_length) {
  std::map<std::array<NodeId, 2>, EdgeId> shortest;
  for (const EdgeId id : graph.Edges()) {
    const auto [a, b] = graph.edge(id).nodes;
    const double length = Length(graph.edge(id).points);
    if (a == b) {
      if (length < min_length && graph.Degree(a) >= 3) graph.RemoveEdge(id);
      continue;
    }
    const auto [other, is_first] = shortest.try_emplace({std::min(a, b), std::max(a, b)}, id);
    if (is_first) continue;
    const double other_length = Length(graph.edge(other->second).points);
    const EdgeId longer = length < other_length ? other->second : id;
    other->second = length < other_length ? id : other->second;
    if (length + other_length < min_length) graph.RemoveEdge(longer);
  }
  graph.DissolveDegree2Nodes();
}

std::vector<std::vector<EdgeId>> ConnectedEdges(const SkeletonGraph& graph) {
  std::vector<std::vector<EdgeId>> parts;
  const std::vector<EdgeId> edges = graph.Edges();
  std::vector<char> visited(edges.empty() ? 0 : edges.back() + 1, false);
  for (const EdgeId first : edges) {
    if (std::exchange(visited[first], true)) continue;
    std::vector<EdgeId> part = {first};
    for (size_t i = 0; i < part.size(); ++i) {
      for (const NodeId node : graph.edge(part[i]).nodes) {
        for (const EdgeId next : graph.IncidentEdges(node)) {
          if (!std::exchange(visited[next], true)) part.push_back(next);
        }
      }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

void DropSmallComponents(SkeletonGraph& graph, double min_length) {
  for (const std::vector<EdgeId>& component : ConnectedEdges(graph)) {
    double length = 0;
    for (const EdgeId id : component) length += Length(graph.edge(id).points);
    if (length >= min_length) continue;
    for (const EdgeId id : component) graph.RemoveEdge(id);
  }
  graph.RemoveIsolatedNodes();
}

}  // namespace curvefusion
