#include "graph/canonical_form.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

int Compare(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  return 0;
}

int Compare(double a, double b) { return a < b ? -1 : a > b; }

// Lexicographic order of two sequences, each read forwards or backwards.
template <class T>
int Compare(const std::vector<T>& a, bool a_reversed, const std::vector<T>& b, bool b_reversed) {
  const size_t common = std::min(a.size(), b.size());
  for (size_t i = 0; i < common; ++i) {
    const int order =
        Compare(a_reversed ? a[a.size() - 1 - i] : a[i], b_reversed ? b[b.size() - 1 - i] : b[i]);
    if (order != 0) return order;
  }
  return Compare(static_cast<double>(a.size()), static_cast<double>(b.size()));
}

int Compare(const SkeletonEdge& a, bool a_reversed, const SkeletonEdge& b, bool b_reversed) {
  int order = Compare(a.points, a_reversed, b.points, b_reversed);
  if (order == 0) order = Compare(a.radii, a_reversed, b.radii, b_reversed);
  if (order == 0) order = Compare(a.observations, a_reversed, b.observations, b_reversed);
  return order;
}

struct DirectedEdge {
  Vec3 first;  // at hand, as it mostly decides
  const SkeletonEdge* edge;
  bool reversed;
};

bool ComesBefore(const DirectedEdge& a, const DirectedEdge& b) {
  const int order = Compare(a.first, b.first);
  return order != 0 ? order < 0 : Compare(*a.edge, a.reversed, *b.edge, b.reversed) < 0;
}

std::vector<DirectedEdge> SortedEdges(const SkeletonGraph& graph) {
  std::vector<DirectedEdge> edges;
  edges.reserve(graph.edge_count());
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    const bool reversed = Compare(edge, true, edge, false) < 0;
    edges.push_back({reversed ? edge.points.back() : edge.points.front(), &edge, reversed});
  }
  std::sort(edges.begin(), edges.end(), ComesBefore);
  return edges;
}

// Adds a node for each position at which edges end, in ascending order: of each old node, the new.
std::vector<NodeId> AddNodes(const SkeletonGraph& graph, SkeletonGraph& canonical) {
  std::vector<std::pair<Vec3, NodeId>> nodes;
  nodes.reserve(graph.node_count());
  for (const NodeId node : graph.Nodes()) {
    // Adding zero makes the two zeros one.
    if (graph.Degree(node) > 0) nodes.emplace_back(graph.position(node) + Vec3::Zero(), node);
  }
  std::vector<NodeId> new_nodes(nodes.empty() ? 0 : nodes.back().second + 1, -1);
  std::sort(nodes.begin(), nodes.end(),
            [](const auto& a, const auto& b) { return Compare(a.first, b.first) < 0; });
  NodeId last = -1;
  for (const auto& [position, node] : nodes) {
    if (last < 0 || canonical.position(last) != position) last = canonical.AddNode(position);
    new_nodes[node] = last;
  }
  return new_nodes;
}

}  // namespace

SkeletonGraph CanonicalForm(const SkeletonGraph& graph) {
  SkeletonGraph canonical;
  const std::vector<NodeId> new_nodes = AddNodes(graph, canonical);
  for (const DirectedEdge& directed : SortedEdges(graph)) {
    SkeletonEdge edge = *directed.edge;
    if (directed.reversed) Reverse(edge);
    for (NodeId& node : edge.nodes) node = new_nodes[node];
    for (Vec3& p : edge.points) p += Vec3::Zero();
    canonical.AddEdge(std::move(edge));
  }
  return canonical;
}

}  // namespace curvefusion
