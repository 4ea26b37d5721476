#include "graph/cycles.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

double MeanObservations(const SkeletonEdge& edge) {
  if (edge.observations.empty()) return 1;
  const double sum = std::accumulate(edge.observations.begin(), edge.observations.end(), 0.0);
  return sum / static_cast<double>(edge.observations.size());
}

// Whether another way than the edge itself leads from one of its ends to the other within a limit
// (Dijkstra).
bool HasOtherWay(const SkeletonGraph& graph, EdgeId id, const std::vector<double>& lengths,
                 double limit) {
  const auto [start, goal] = graph.edge(id).nodes;
  if (start == goal) return limit >= 0;
  using Entry = std::pair<double, NodeId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::map<NodeId, double> reached = {{start, 0.0}};
  open.emplace(0.0, start);
  while (!open.empty()) {
    const auto [distance, node] = open.top();
    open.pop();
    if (node == goal) return true;
    if (distance > reached[node]) continue;
    for (const EdgeId next : graph.IncidentEdges(node)) {
      const NodeId other = graph.OtherEnd(next, node);
      const double there = distance + lengths[next];
      if (next == id || there > limit) continue;
      const auto [found, is_new] = reached.emplace(other, there);
      if (!is_new && found->second <= there) continue;
      found->second = there;
      open.emplace(there, other);
    }
  }
  return false;
}

}  // namespace

void RemoveSmallCycles(SkeletonGraph& graph, double length) {
  const std::vector<EdgeId> edges = graph.Edges();
  std::vector<double> lengths(edges.empty() ? 0 : edges.back() + 1);
  std::vector<std::tuple<double, double, EdgeId>> candidates;
  for (const EdgeId id : edges) {
    lengths[id] = Length(graph.edge(id).points);
    if (lengths[id] < length)
      candidates.emplace_back(MeanObservations(graph.edge(id)), -lengths[id], id);
  }
  std::sort(candidates.begin(), candidates.end());
  for (const auto& [observations, negative_length, id] : candidates)
    if (HasOtherWay(graph, id, lengths, length - lengths[id])) graph.RemoveEdge(id);
  graph.RemoveIsolatedNodes();
}

}  // namespace curvefusion
