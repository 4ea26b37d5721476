#pragma once

#include <boost/graph/graph_traits.hpp>
#include <boost/graph/properties.hpp>
#include <boost/iterator/transform_iterator.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <utility>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// An edge of a BoostView, seen from one of its ends.
struct BoostEdge {
  NodeId source = -1;
  NodeId target = -1;
  EdgeId id = -1;

  friend bool operator==(const BoostEdge& a, const BoostEdge& b) { return a.id == b.id; }
  friend bool operator!=(const BoostEdge& a, const BoostEdge& b) { return a.id != b.id; }
};

/// A skeleton graph as a model of Boost's VertexListGraph, EdgeListGraph and IncidenceGraph
/// (undirected, parallel edges and self-loops allowed), so that Boost's algorithms run on it:
///   const BoostView view(graph);
///   boost::connected_components(view, component_map);
/// Vertices are node handles; get(boost::vertex_index, view) numbers the live ones from 0 and
/// get(boost::edge_weight, view) is the length of an edge in metres. The graph must outlive the
/// view and not change meanwhile. Made in linear time, lengths included.
class BoostView {
 public:
  explicit BoostView(const SkeletonGraph& graph)
      : graph_(&graph), nodes_(graph.Nodes()), edges_(graph.Edges()) {
    indices_.resize(nodes_.empty() ? 0 : nodes_.back() + 1, -1);
    for (size_t i = 0; i < nodes_.size(); ++i) indices_[nodes_[i]] = static_cast<int>(i);
    lengths_.resize(edges_.empty() ? 0 : edges_.back() + 1);
    for (const EdgeId id : edges_) lengths_[id] = Length(graph.edge(id).points);
  }

  const SkeletonGraph& graph() const { return *graph_; }
  const std::vector<NodeId>& nodes() const { return nodes_; }
  const std::vector<EdgeId>& edges() const { return edges_; }
  int IndexOf(NodeId node) const { return indices_[node]; }
  double LengthOf(EdgeId edge) const { return lengths_[edge]; }

 private:
  const SkeletonGraph* graph_;
  std::vector<NodeId> nodes_;
  std::vector<EdgeId> edges_;
  std::vector<int> indices_;     // of each node handle
  std::vector<double> lengths_;  // of each edge handle
};

/// Turns an edge handle into an edge seen from a node, or from its first node.
struct BoostEdgeOf {
  const SkeletonGraph* graph = nullptr;
  NodeId source = -1;

  BoostEdge operator()(EdgeId id) const {
    const auto& [first, last] = graph->edge(id).nodes;
    if (source < 0 || source == first) return {first, last, id};
    return {last, first, id};
  }
};

}  // namespace curvefusion

namespace boost {

template <>
struct graph_traits<curvefusion::BoostView> {
  using vertex_descriptor = curvefusion::NodeId;
  using edge_descriptor = curvefusion::BoostEdge;
  using directed_category = undirected_tag;
  using edge_parallel_category = allow_parallel_edge_tag;
  struct traversal_category : vertex_list_graph_tag, edge_list_graph_tag, incidence_graph_tag {};
  using vertices_size_type = int;
  using edges_size_type = int;
  using degree_size_type = int;
  using vertex_iterator = std::vector<curvefusion::NodeId>::const_iterator;
  using edge_iterator = transform_iterator<curvefusion::BoostEdgeOf, const curvefusion::EdgeId*>;
  using out_edge_iterator = edge_iterator;
  static vertex_descriptor null_vertex() { return -1; }
};

}  // namespace boost

namespace curvefusion {

using BoostTraits = boost::graph_traits<BoostView>;

inline std::pair<BoostTraits::vertex_iterator, BoostTraits::vertex_iterator> vertices(
    const BoostView& view) {
  return {view.nodes().begin(), view.nodes().end()};
}
inline int num_vertices(const BoostView& view) { return static_cast<int>(view.nodes().size()); }

inline std::pair<BoostTraits::edge_iterator, BoostTraits::edge_iterator> edges(
    const BoostView& view) {
  const BoostEdgeOf edge_of{&view.graph(), -1};
  const EdgeId* first = view.edges().data();
  return {{first, edge_of}, {first + view.edges().size(), edge_of}};
}
inline int num_edges(const BoostView& view) { return static_cast<int>(view.edges().size()); }

inline std::pair<BoostTraits::out_edge_iterator, BoostTraits::out_edge_iterator> out_edges(
    NodeId node, const BoostView& view) {
  const std::span<const EdgeId> incident = view.graph().IncidentEdges(node);
  const BoostEdgeOf edge_of{&view.graph(), node};
  return {{incident.data(), edge_of}, {incident.data() + incident.size(), edge_of}};
}
inline int out_degree(NodeId node, const BoostView& view) { return view.graph().Degree(node); }

inline NodeId source(const BoostEdge& edge, const BoostView&) { return edge.source; }
inline NodeId target(const BoostEdge& edge, const BoostView&) { return edge.target; }

struct BoostVertexIndex {
  const BoostView* view;
  int operator()(NodeId node) const { return view->IndexOf(node); }
};
inline auto get(boost::vertex_index_t, const BoostView& view) {
  return boost::make_function_property_map<NodeId, int>(BoostVertexIndex{&view});
}

struct BoostEdgeLength {
  const BoostView* view;
  double operator()(const BoostEdge& edge) const { return view->LengthOf(edge.id); }
};
inline auto get(boost::edge_weight_t, const BoostView& view) {
  return boost::make_function_property_map<BoostEdge, double>(BoostEdgeLength{&view});
}

}  // namespace curvefusion

namespace boost {

template <>
struct property_map<curvefusion::BoostView, vertex_index_t> {
  using type = function_property_map<curvefusion::BoostVertexIndex, curvefusion::NodeId, int>;
  using const_type = type;
};

template <>
struct property_map<curvefusion::BoostView, edge_weight_t> {
  using type = function_property_map<curvefusion::BoostEdgeLength, curvefusion::BoostEdge, double>;
  using const_type = type;
};

}  // namespace boost
