#pragma once

#include <array>
#include <boost/container/small_vector.hpp>
#include <span>
#include <utility>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// Handles stay valid until their node or edge is removed; they are never reused.
using NodeId = int;
using EdgeId = int;

/// A curve between two nodes. `points` runs from nodes[0] to nodes[1]; its ends equal the nodes'
/// positions bit for bit. `radii` and `observations` are empty or hold one value per point.
struct SkeletonEdge {
  std::array<NodeId, 2> nodes{};
  Polyline points;                   ///< metres, at least two
  std::vector<double> radii;         ///< tube radius in metres, > 0
  std::vector<double> observations;  ///< in how many frames or bundles the point was seen
};

/// Turns the direction of an edge around.
void Reverse(SkeletonEdge& edge);

/// The points `first` to `last` of an edge, both included, between two nodes that lie there.
SkeletonEdge PartOf(const SkeletonEdge& edge, size_t first, size_t last,
                    const std::array<NodeId, 2>& nodes);

/// The curve skeleton: an undirected multigraph whose edges are polylines in space. Parallel edges
/// and self-loops are allowed; a closed curve without a junction is one edge from a node to itself.
/// Copyable; a value like any other.
class SkeletonGraph {
 public:
  /// Makes room for nodes and edges that are to be added, not much more than is asked for.
  void Reserve(size_t nodes, size_t edges);

  /// Adds an isolated node.
  NodeId AddNode(const Vec3& position);

  /// Adds an edge. The ends of edge.points must equal the positions of edge.nodes bit for bit.
  EdgeId AddEdge(SkeletonEdge edge);

  /// Adds a curve with two new nodes at its ends (one where it is closed: front() == back()).
  EdgeId AddPolyline(Polyline points);

  /// Removes an edge; its nodes stay.
  void RemoveEdge(EdgeId edge) { TakeEdge(edge); }

  /// Removes an edge and returns it.
  SkeletonEdge TakeEdge(EdgeId edge);

  /// Moves out all edges, indexed by handle (empty where removed). The graph must not be used again
  /// before PutEdges has put them back.
  std::vector<SkeletonEdge> TakeEdges() { return std::move(edges_); }
  void PutEdges(std::vector<SkeletonEdge> edges) { edges_ = std::move(edges); }

  /// Removes a node without edges.
  void RemoveNode(NodeId node);

  /// Removes nodes without edges: all, or with `since` > 0 those changed after that version().
  void RemoveIsolatedNodes(int since = 0);

  /// Moves a node and with it the ends of its edges.
  void MoveNode(NodeId node, const Vec3& position);

  /// Replaces the curve of an edge; the nodes stay, so the ends must equal them.
  void SetCurve(EdgeId edge, Polyline points, std::vector<double> radii = {},
                std::vector<double> observations = {});

  /// Makes a point of an edge, by its index with 0 < index < points.size() - 1, a node: the edge is
  /// replaced by two. Returns the node.
  NodeId SplitEdge(EdgeId edge, size_t point_index);

  /// Makes `merged` disappear into `kept`: its edges end in `kept`'s position from now on. Edges
  /// between the two that shrink to a point are removed. One to a third node at the same position
  /// has no length then, but ties that node (RemoveZeroLengthSegments makes it one with `kept`).
  void MergeNodes(NodeId kept, NodeId merged);

  /// Joins the two edges of every node of degree 2 into one; `since` as in RemoveIsolatedNodes. A
  /// closed curve keeps one node.
  void DissolveDegree2Nodes(int since = 0);

  bool HasNode(NodeId node) const;
  bool HasEdge(EdgeId edge) const;
  const Vec3& position(NodeId node) const;
  const SkeletonEdge& edge(EdgeId edge) const;

  /// Handles of all nodes (edges) in ascending order; `since` as in RemoveIsolatedNodes.
  std::vector<NodeId> Nodes(int since = 0) const;
  std::vector<EdgeId> Edges(int since = 0) const;

  /// Grows with every change. A node changes with its position and the edges that end there, an
  /// edge with its curve and its nodes.
  int version() const { return version_; }
  /// The version at which an edge changed last.
  int version(EdgeId edge) const { return edge_versions_[edge]; }

  int node_count() const { return node_count_; }
  int edge_count() const { return edge_count_; }
  size_t point_count() const { return point_count_; }  ///< of all curves together
  bool empty() const { return edge_count_ == 0; }

  /// Edges at a node, until one is added or removed; a self-loop stands there twice.
  std::span<const EdgeId> IncidentEdges(NodeId node) const;
  int Degree(NodeId node) const { return static_cast<int>(IncidentEdges(node).size()); }

  /// The node at which an edge ends that begins at `node`; for a self-loop the same.
  NodeId OtherEnd(EdgeId edge, NodeId node) const;

  /// Has what will be read soon fetched from memory, which pays where handles come in no order: a
  /// node, an edge, the points of an edge that has been fetched.
  void FetchNode(NodeId node) const { __builtin_prefetch(&nodes_[node]); }
  void FetchEdge(EdgeId edge) const { __builtin_prefetch(&edges_[edge]); }
  void FetchPoints(EdgeId edge) const { __builtin_prefetch(edges_[edge].points.data()); }

  /// Sum of the lengths of all edges in metres.
  double TotalLength() const;

  /// Number of connected components among the nodes with edges.
  int ComponentCount() const;

  /// Number of independent cycles: edges - nodes with edges + components.
  int CycleRank() const;

 private:
  // One cache line each: what is asked of a node is asked in no order of memory. Moving one does
  // not throw, as there is room for as many edges where they come to.
  struct alignas(64) Node {  // NOLINT(bugprone-exception-escape)
    Vec3 position;
    boost::container::small_vector<EdgeId, 4> edges;  // more meet at few nodes only
  };
  void Attach(NodeId node, EdgeId edge);
  void Detach(NodeId node, EdgeId edge);
  bool IsInsideCurve(NodeId node) const;
  SkeletonEdge TakeChain(NodeId first, EdgeId next);
  void DissolveChainsFrom(NodeId node);

  // At which version each of many items changed last, and which have since some version.
  class Versions {
   public:
    void Reserve(size_t more);
    void Add() { of_items_.push_back(0); }
    void Set(int item, int version);
    void SetRemoved(int item) { of_items_[item] = 0; }
    int operator[](int item) const { return of_items_[item]; }
    bool Has(int item) const;
    std::vector<int> ChangedSince(int version, int live_count) const;

   private:
    static constexpr int kBlock = 64;  // items that are looked at together; chosen
    std::vector<int> of_items_;        // 0 where the item is no more
    std::vector<int> of_blocks_;       // of so many items, no earlier than any of them
  };

  void TouchNode(NodeId node) { node_versions_.Set(node, ++version_); }
  void TouchEdge(EdgeId edge) { edge_versions_.Set(edge, ++version_); }

  std::vector<Node> nodes_;  // removed ones have no edges
  std::vector<SkeletonEdge> edges_;
  Versions node_versions_;
  Versions edge_versions_;
  int version_ = 0;
  int node_count_ = 0;
  int isolated_count_ = 0;  // of nodes without edges
  int edge_count_ = 0;
  size_t point_count_ = 0;
};

/// The box around the points of all curves; empty without any.
Eigen::AlignedBox3d BoundsOf(const SkeletonGraph& graph);

/// Adds the nodes and edges of another graph; nothing is joined.
void Append(const SkeletonGraph& more, SkeletonGraph& graph);

/// The graph after a motion or another affine map; radii stay.
SkeletonGraph Transformed(const SkeletonGraph& graph, const AffineTransform& T);

}  // namespace curvefusion
