#include "graph/canonical_form.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "kernel/morton_order.h"
#include "kernel/radix_sort.h"

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

// In canonical order nodes and edges lie anywhere in memory: what is needed so many of them later
// is fetched in time. Chosen: only the time depends on it.
constexpr size_t kLookahead = 12;

// Where a position comes in the order of nodes, as far as 63 bits tell.
struct SortedNode {
  uint64_t code;
  NodeId node;
};

std::vector<SortedNode> SortedNodes(const SkeletonGraph& graph) {
  std::vector<SortedNode> sorted;
  sorted.reserve(graph.node_count());
  for (const NodeId node : graph.Nodes())
    if (graph.Degree(node) > 0) sorted.push_back({MortonCode(graph.position(node)), node});
  RadixSort(sorted, [](const SortedNode& node) { return node.code; });
  for (auto begin = sorted.begin(); begin != sorted.end();) {
    const auto end = std::find_if(begin + 1, sorted.end(), [begin](const SortedNode& node) {
      return node.code != begin->code;
    });
    std::sort(begin, end, [&graph](const SortedNode& a, const SortedNode& b) {
      return ComesBefore(graph.position(a.node), graph.position(b.node));
    });
    begin = end;
  }
  return sorted;
}

// Adds a node for each position at which edges end, in ascending order: of each old node, the new.
std::vector<NodeId> AddNodes(const SkeletonGraph& graph, SkeletonGraph& canonical) {
  std::vector<NodeId> new_nodes;
  NodeId last = -1;
  const std::vector<SortedNode> sorted = SortedNodes(graph);
  for (size_t i = 0; i < sorted.size(); ++i) {
    if (i + kLookahead < sorted.size())
      __builtin_prefetch(&graph.position(sorted[i + kLookahead].node));
    const NodeId node = sorted[i].node;
    // Adding zero makes the two zeros one.
    const Vec3 position = graph.position(node) + Vec3::Zero();
    if (last < 0 || canonical.position(last) != position) last = canonical.AddNode(position);
    if (static_cast<size_t>(node) >= new_nodes.size()) new_nodes.resize(node + 1, -1);
    new_nodes[node] = last;
  }
  return new_nodes;
}

struct DirectedEdge {
  NodeId first;  // in the canonical form
  EdgeId edge;
  bool reversed;
};

bool IsReversed(const SkeletonEdge& edge, NodeId front, NodeId back) {
  return front != back ? back < front : Compare(edge, true, edge, false) < 0;
}

// New nodes are in the order of their positions, so edges are by that of their first one, and only
// edges from the same node have to be compared.
std::vector<DirectedEdge> SortedEdges(const SkeletonGraph& graph,
                                      const std::vector<NodeId>& new_nodes, int new_node_count) {
  std::vector<DirectedEdge> edges;
  edges.reserve(graph.edge_count());
  std::vector<int> begins(static_cast<size_t>(new_node_count) + 1, 0);
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    const NodeId front = new_nodes[edge.nodes[0]];
    const NodeId back = new_nodes[edge.nodes[1]];
    const bool reversed = IsReversed(edge, front, back);
    edges.push_back({reversed ? back : front, id, reversed});
    ++begins[edges.back().first + 1];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<DirectedEdge> sorted(edges.size());
  std::vector<int> ends(begins.begin(), begins.end() - 1);
  for (const DirectedEdge& edge : edges) sorted[ends[edge.first]++] = edge;
  for (size_t node = 0; node < ends.size(); ++node)
    if (ends[node] - begins[node] > 1)
      std::sort(sorted.begin() + begins[node], sorted.begin() + ends[node],
                [&graph](const DirectedEdge& a, const DirectedEdge& b) {
                  return Compare(graph.edge(a.edge), a.reversed, graph.edge(b.edge), b.reversed) <
                         0;
                });
  return sorted;
}

// What the canonical form of a graph consists of but for the curves.
struct CanonicalOrder {
  SkeletonGraph nodes;            // of the canonical form
  std::vector<NodeId> new_nodes;  // of each old node
  std::vector<DirectedEdge> edges;
};

// With room for so many times what the graph has.
CanonicalOrder OrderOf(const SkeletonGraph& graph, int node_room = 1, int edge_room = 1) {
  CanonicalOrder order;
  order.nodes.Reserve(static_cast<size_t>(node_room) * graph.node_count(),
                      static_cast<size_t>(edge_room) * graph.edge_count());
  order.new_nodes = AddNodes(graph, order.nodes);
  order.edges = SortedEdges(graph, order.new_nodes, order.nodes.node_count());
  return order;
}

// `at` refers to an edge of the graph by its handle, `take` gives its value.
template <class At, class Take>
SkeletonGraph InCanonicalOrder(CanonicalOrder order, const At& at, const Take& take) {
  const size_t count = order.edges.size();
  for (size_t i = 0; i < count; ++i) {
    if (i + 2 * kLookahead < count) {
      const SkeletonEdge& later = at(order.edges[i + 2 * kLookahead].edge);
      __builtin_prefetch(&later.nodes);
      __builtin_prefetch(&later.observations);  // may lie on the next line
    }
    if (i + kLookahead < count) {
      const SkeletonEdge& later = at(order.edges[i + kLookahead].edge);
      __builtin_prefetch(later.points.data());
      __builtin_prefetch(&later.points.back());
      for (const NodeId node : later.nodes)
        __builtin_prefetch(&order.nodes.position(order.new_nodes[node]));
    }
    SkeletonEdge edge = take(order.edges[i].edge);
    if (order.edges[i].reversed) Reverse(edge);
    for (NodeId& node : edge.nodes) node = order.new_nodes[node];
    for (Vec3& p : edge.points) p += Vec3::Zero();
    order.nodes.AddEdge(std::move(edge));
  }
  return std::move(order.nodes);
}

SkeletonGraph WithCurvesOf(std::vector<SkeletonEdge> edges, CanonicalOrder order) {
  return InCanonicalOrder(
      std::move(order), [&edges](EdgeId id) -> const SkeletonEdge& { return edges[id]; },
      [&edges](EdgeId id) { return std::move(edges[id]); });
}

}  // namespace

SkeletonGraph CanonicalForm(const SkeletonGraph& graph) {
  const auto at = [&graph](EdgeId id) -> const SkeletonEdge& { return graph.edge(id); };
  return InCanonicalOrder(OrderOf(graph), at, at);
}

SkeletonGraph CanonicalForm(SkeletonGraph&& graph) {
  CanonicalOrder order = OrderOf(graph);
  return WithCurvesOf(graph.TakeEdges(), std::move(order));
}

LentCanonicalForm::LentCanonicalForm(SkeletonGraph& graph) : graph_(graph) {
  CanonicalOrder order = OrderOf(graph, 2, 4);
  origins_.reserve(order.edges.size());
  for (const auto& [first, edge, reversed] : order.edges)
    origins_.push_back({edge, reversed, graph.edge(edge).nodes});
  std::vector<SkeletonEdge> edges = graph.TakeEdges();
  slots_ = edges.size();
  form_ = WithCurvesOf(std::move(edges), std::move(order));
}

void LentCanonicalForm::Return(SkeletonGraph form) {
  std::vector<SkeletonEdge> edges = form.TakeEdges();
  std::vector<SkeletonEdge> returned(slots_);
  for (size_t i = 0; i < edges.size(); ++i) {
    const auto& [edge, reversed, nodes] = origins_[i];
    if (reversed) Reverse(edges[i]);
    edges[i].nodes = nodes;
    returned[edge] = std::move(edges[i]);
  }
  graph_.PutEdges(std::move(returned));
}

}  // namespace curvefusion
