#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// An end of an edge; one is open that no other edge continues.
struct OpenEnd {
  NodeId node = -1;
  EdgeId edge = -1;
  Vec3 position;
  Vec3 outward;          ///< unit; zero for an edge without length
  bool is_free = false;  ///< nothing else ends at the node
};

/// The piece of an edge next to its end that gives the end's direction.
struct EndPiece {
  double skipped = 0;  ///< metres; the very end, which other wires may draw sideways
  double length = 0;   ///< metres
};

/// A curve that is met so near to its end is met there, metres. Chosen: depth draws curves up to 6
/// mm beside their wires.
inline constexpr double kSnapDistance = 0.006;

/// The ends of all edges at a node, whether open or not; a self-loop has two.
std::vector<OpenEnd> EndsAt(const SkeletonGraph& graph, NodeId node, const EndPiece& piece);

/// Free ends, and branches of junctions that nothing leaves on the other side within 45 degrees, by
/// node.
std::vector<OpenEnd> OpenEnds(const SkeletonGraph& graph, const EndPiece& piece);

/// The end of the only edge at a node.
OpenEnd FreeEnd(const SkeletonGraph& graph, NodeId node, const EndPiece& piece);

}  // namespace curvefusion
