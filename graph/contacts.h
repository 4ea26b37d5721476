#pragma once

#include <vector>

#include "graph/junctions.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A stretch along which two edges, or two parts of one, come within a threshold of each other
/// without need: neither close to a node they share nor because the curve is continuous there.
struct Contact {
  LocationPair closest;  ///< where they are nearest
  double distance = 0;   ///< there, metres
  LocationPair first;    ///< the ends of the stretch, ordered along the first edge
  LocationPair last;
  double first_gap = 0;  ///< arc length between the two places over a shared node or along the
  double last_gap = 0;   ///< common edge; infinite where there is no such way
  bool overlap = false;  ///< the edges run side by side, longer than one node would explain
};

/// Arc length in thresholds over which two parts of the graph that hang together may stay near each
/// other: arms of a fork of more than 20 degrees have parted by then.
inline constexpr double kConnectedReach = 6;

/// All contacts of a graph, in an order that depends on the graph only. Whether two segments are
/// within the threshold (limit included) is decided exactly on the stored coordinates. Parts of the
/// graph with less than kConnectedReach thresholds of arc length between them, over at most one
/// node, are no contact as long as they come out of one another: two arms of a fork near their node
/// are none, a curve that returns to itself in a loop is one. Cost O(n log n + k) in segments and
/// in pairs of segments within the threshold; segments longer than the threshold are cut in
/// thought.
std::vector<Contact> FindContacts(const SkeletonGraph& graph, double threshold);

/// The places that have to become one node to resolve a contact: the nearest ones; for an overlap,
/// those at its two ends, as far as they are not at a node already.
std::vector<LocationPair> PlacesToJoin(const Contact& contact, double threshold);

}  // namespace curvefusion
