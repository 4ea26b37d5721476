#pragma once

#include <array>
#include <utility>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The same graph with handles, directions of edges and order that depend on its geometry alone, so
/// that two graphs that differ in nothing else have the same canonical form: nodes without edges
/// are left out, nodes at one position become one and are numbered in the order of their positions
/// (kernel/morton_order.h), in which neighbours in space mostly lie near each other in memory,
/// edges in the order of their nodes and between those by their coordinates, from 0 without gaps,
/// and each edge runs in the direction that comes first. O(n log n) in points. A graph that is
/// given up need not be copied.
SkeletonGraph CanonicalForm(const SkeletonGraph& graph);
SkeletonGraph CanonicalForm(SkeletonGraph&& graph);

/// The canonical form of a graph that lends it its curves until it is known whether they are to
/// change: nothing is copied. There is room for as many nodes and three times as many edges to be
/// added.
class LentCanonicalForm {
 public:
  explicit LentCanonicalForm(SkeletonGraph& graph);

  /// The canonical form, once.
  SkeletonGraph Take() { return std::move(form_); }

  /// Gives the graph its curves back, from a form in which none has changed; but for the sign of
  /// zeros it is as it was.
  void Return(SkeletonGraph form);

 private:
  struct Origin {
    EdgeId edge;
    bool reversed;
    std::array<NodeId, 2> nodes;
  };
  SkeletonGraph& graph_;
  SkeletonGraph form_;
  std::vector<Origin> origins_;  // of each edge of the form
  size_t slots_ = 0;             // for edges of the graph, by their handles
};

}  // namespace curvefusion
