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
  const SkeletonEdge* edge;
  bool reversed;
};

std::vector<DirectedEdge> SortedEdges(const SkeletonGraph& graph) {
  std::vector<DirectedEdge> edges;
  edges.reserve(graph.edge_count());
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    edges.push_back({&edge, Compare(edge, true, edge, false) < 0});
  }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return Compare(*a.edge, a.reversed, *b.edge, b.reversed) < 0;
  });
  return edges;
}

// Adds a node for each position at which edges end, in ascending order: of each old node, the new.
std::vector<NodeId> AddNodes(const SkeletonGraph& graph, SkeletonGraph& canonical) {
  std::vector<NodeId> nodes = graph.Nodes();
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                             [&graph](NodeId node) { return graph.Degree(node) == 0; }),
              nodes.end());
  std::vector<NodeId> new_nodes(nodes.empty() ? 0 : nodes.back() + 1, -1);
  std::sort(nodes.begin(), nodes.end(), [&graph](NodeId a, NodeId b) {
    return Compare(graph.position(a), graph.position(b)) < 0;
  });
  NodeId last = -1;
  for (const NodeId node : nodes) {
    // Adding zero makes the two zeros one.
    const Vec3 position = graph.position(node) + Vec3::Zero();
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
