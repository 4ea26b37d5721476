#pragma once

#include <utility>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A place on an edge: metres of arc length from its first point.
struct CurveLocation {
  EdgeId edge = -1;
  double arc_length = 0;
};

/// Two places that are to become one node.
using LocationPair = std::pair<CurveLocation, CurveLocation>;

/// Nodes that are to become one, and a weight for each.
struct NodeGroup {
  std::vector<NodeId> nodes;
  std::vector<double> weights;
};

/// Merges each group of nodes into its first node, at the weighted mean of their positions; the
/// curves bend towards it over a few times the distance moved, with a point added where a long
/// segment would carry the bend too far; without links (`max_link` 0) only the nodes move. Edges
/// within a group disappear where they are no longer than `max_link`, longer ones become
/// self-loops. Groups must not share nodes.
void MergeNodeGroups(SkeletonGraph& graph, const std::vector<NodeGroup>& groups, double max_link);

/// Merges nodes that links hang together, each set all at once: as MergeNodeGroups does, weighted
/// by degree. Returns how many nodes came of several.
int MergeLinkedNodes(SkeletonGraph& graph, const std::vector<std::pair<NodeId, NodeId>>& links,
                     double max_link);

/// Makes every pair of places one node, and places that are linked by several pairs one node all
/// together: edges are split there and the nodes merged (MergeLinkedNodes, links up to 3 `snap`). A
/// place within `snap` metres of arc length of an end of its edge stands for the node at that end,
/// and places within `snap` of each other on one edge are one. The handles of split edges become
/// invalid. Cost O(n log n) in pairs and points of the graph. CurveFusion 4.3: "we create a new
/// junction at this intersection and split each of the segments accordingly".
void JoinLocations(SkeletonGraph& graph, const std::vector<LocationPair>& pairs, double snap);

}  // namespace curvefusion
