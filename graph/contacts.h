#pragma once

#include <vector>

#include "graph/junctions.h"
#include "graph/segment_pairs.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A stretch along which two edges, or two parts of one, come within a threshold of each other
/// without need: segments in contact (graph/segment_pairs.h) that follow one another on both. With
/// a threshold below rounding, each pair of segments is one.
struct Contact {
  LocationPair closest;    ///< where they are nearest
  double distance = 0;     ///< there, metres
  double closest_gap = 0;  ///< arc length between the two places over a shared node or along the
                           ///< common edge; infinite where there is no such path
  LocationPair first;      ///< the ends of the stretch, ordered along the first edge
  LocationPair last;
  double first_gap = 0;  ///< as closest_gap
  double last_gap = 0;
  bool overlap = false;  ///< the edges run side by side, longer than one node would explain
};

/// All contacts of a graph, in an order that depends on the graph only; none exactly where no two
/// segments are in contact, which is decided exactly on the stored coordinates. Extent and places
/// of a contact are rounded. No segment may have length zero. Parts of the graph with less than
/// kConnectedReach thresholds of arc length between them, over at most one node, are a contact only
/// where they have a point in common: two arms of a fork near their node are none, nor is a
/// hairpin, but a curve that crosses itself is. Cost O(n log n + k log k) in segments and in pairs
/// of segments whose boxes, grown by the threshold, meet.
std::vector<Contact> FindContacts(const SkeletonGraph& graph, double threshold);

/// FindContacts for one graph that changes from call to call: what it found about edges that have
/// not changed since the last call it knows.
class ContactSearch {
 public:
  explicit ContactSearch(double threshold);

  /// The same contacts as FindContacts.
  std::vector<Contact> Find(const SkeletonGraph& graph);

  double largest_coordinate() const { return pairs_.largest_coordinate(); }  ///< of the last graph

 private:
  double threshold_;
  SegmentPairSearch pairs_;
};

/// The places that have to become one node to resolve a contact: the nearest ones, or where these
/// are at one node already, the end of the stretch farther from it; for an overlap, those at its
/// two ends, as far as they are not at a node already. Where one edge folds back onto itself, the
/// fold is a place of its own, paired with itself. Places no more than `snap` from a node are at
/// it, above zero; `reach` is the arc length over a node up to which FindContacts excuses nearness.
std::vector<LocationPair> PlacesToJoin(const Contact& contact, double snap, double reach);

}  // namespace curvefusion
