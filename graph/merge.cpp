#include "graph/merge.h"

#include <algorithm>
#include <array>
#include <set>

#include "graph/junctions.h"

namespace curvefusion {

namespace {

bool IsDangling(const SkeletonGraph& graph, const SkeletonEdge& edge) {
  return graph.Degree(edge.nodes[0]) == 1 || graph.Degree(edge.nodes[1]) == 1;
}

// Short edges of a graph, shortest first.
std::vector<EdgeId> ShortEdges(const SkeletonGraph& graph, double length) {
  std::vector<std::pair<double, EdgeId>> found;
  for (const EdgeId id : graph.Edges()) {
    const double edge_length = Length(graph.edge(id).points);
    if (edge_length < length) found.emplace_back(edge_length, id);
  }
  std::sort(found.begin(), found.end());
  std::vector<EdgeId> edges;
  edges.reserve(found.size());
  for (const auto& entry : found) edges.push_back(entry.second);
  return edges;
}

}  // namespace

void ContractEdges(SkeletonGraph& graph, const std::vector<EdgeId>& edges) {
  std::vector<NodeGroup> groups;
  std::set<NodeId> touched;
  double longest = 0;
  for (const EdgeId id : edges) {
    const std::array<NodeId, 2> nodes = graph.edge(id).nodes;
    const bool is_free = std::none_of(nodes.begin(), nodes.end(),
                                      [&touched](NodeId node) { return touched.count(node) > 0; });
    if (!is_free) continue;
    NodeGroup group;
    for (const NodeId node : nodes) {
      group.nodes.push_back(node);
      group.weights.push_back(graph.Degree(node));
      touched.insert(node);
    }
    groups.push_back(std::move(group));
    longest = std::max(longest, Length(graph.edge(id).points));
  }
  MergeNodeGroups(graph, groups, longest);
}

void RemoveShortEdges(SkeletonGraph& graph, double length) {
  graph.DissolveDegree2Nodes();
  for (std::vector<EdgeId> edges = ShortEdges(graph, length); !edges.empty();
       edges = ShortEdges(graph, length)) {
    std::vector<EdgeId> links;
    for (const EdgeId id : edges) {
      const SkeletonEdge& edge = graph.edge(id);
      if (edge.nodes[0] == edge.nodes[1] || IsDangling(graph, edge)) {
        graph.RemoveEdge(id);
      } else {
        links.push_back(id);
      }
    }
    ContractEdges(graph, links);
    graph.RemoveIsolatedNodes();
    graph.DissolveDegree2Nodes();
  }
}

void PruneSpurs(SkeletonGraph& graph, double length) {
  graph.DissolveDegree2Nodes();
  const auto is_spur = [&graph](EdgeId id) {
    const std::array<NodeId, 2>& nodes = graph.edge(id).nodes;
    return IsDangling(graph, graph.edge(id)) &&
           std::max(graph.Degree(nodes[0]), graph.Degree(nodes[1])) >= 3;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (const EdgeId id : ShortEdges(graph, length)) {
      if (!is_spur(id)) continue;
      graph.RemoveEdge(id);
      changed = true;
    }
    graph.RemoveIsolatedNodes();
    graph.DissolveDegree2Nodes();
  }
}

void RemoveSmallLoops(SkeletonGraph& graph, double length, int since) {
  for (const EdgeId id : graph.Edges(since)) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.nodes[0] == edge.nodes[1] && Length(edge.points) <= length) graph.RemoveEdge(id);
  }
  graph.RemoveIsolatedNodes(since);
}

}  // namespace curvefusion
