#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// An end of an edge that no other edge continues.
struct OpenEnd {
  NodeId node = 0;
  EdgeId edge = 0;
  Vec3 position;
  Vec3 outward;  ///< unit; the direction of the last `fit_length` of the edge
  bool is_free = false;  ///< nothing else ends at the node
};

/// Free ends, and branches of junctions that nothing leaves on the other side within 45 degrees, by
/// node.
std::vector<OpenEnd> OpenEnds(const SkeletonGraph& graph, double fit_length);

/// The end of the only edge at a node.
OpenEnd FreeEnd(const SkeletonGraph& graph, NodeId node, double fit_length);

}  // namespace curvefusion
