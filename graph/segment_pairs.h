#pragma once

#include <vector>

#include "graph/segment_table.h"
#include "kernel/box_pairs.h"

namespace curvefusion {

/// Arc length in thresholds over which two parts of the graph that hang together may stay near each
/// other. Chosen: straight arms of a fork of more than 2 asin(1/6), 19 degrees, have parted by
/// then.
inline constexpr double kConnectedReach = 6;

/// Two segments of a table, s < t.
struct SegmentPair {
  int s;
  int t;
  auto operator<=>(const SegmentPair&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The paths along the graph between two segments, along their common curve or over one common
/// node, on which some of their points are nearer to each other than `reach`.
std::vector<LinearGap> ShortPaths(const SegmentTable& table, const SegmentPair& pair, double reach);

/// All pairs of segments in contact, ascending. Two segments are in contact where
/// - they have a point in common other than a node or a vertex they share, or
/// - they have points within the threshold (limit included) of each other between which every path,
///   along the common curve or over one common node, is at least kConnectedReach thresholds long;
///   this applies to thresholds above zero.
/// Decided exactly on the stored coordinates and on arc lengths as the table has them. No segment
/// may have length zero. O(n log n + k) in segments and in pairs whose boxes meet.
std::vector<SegmentPair> SegmentPairsInContact(const SegmentTable& table, double threshold);

/// Whether one pair is in contact.
bool AreInContact(const SegmentTable& table, const SegmentPair& pair, double threshold);

/// SegmentPairsInContact for one graph that changes from call to call. Whether two segments are in
/// contact depends on their own edges only, so of pairs only those are decided of which an edge has
/// changed since the last call.
class SegmentPairSearch {
 public:
  explicit SegmentPairSearch(double threshold) : threshold_(threshold) {}

  /// Looks at the graph as it is now.
  void Update(const SkeletonGraph& graph);

  /// Curves of the graph, ascending: at least those in contact.
  const SegmentTable& table() const { return HasExtension() ? part_ : table_; }
  /// All pairs in contact, as numbers of that table, ascending.
  const std::vector<SegmentPair>& pairs() const { return HasExtension() ? part_pairs_ : pairs_; }

  double largest_coordinate() const { return largest_coordinate_; }  ///< of the graph

 private:
  bool HasExtension() const { return table_.curve_count() > tree_curves_; }
  void DropChanged(const SkeletonGraph& graph);
  void Restart(const SkeletonGraph& graph);
  void Extend(const SkeletonGraph& graph, const std::vector<EdgeId>& changed);
  void CollectPart(const SkeletonGraph& graph);
  double LargestOfCurrent() const;

  double threshold_;
  SegmentTable table_;              // curves of the tree, then those that have changed since
  std::vector<char> is_current_;    // of each curve: its edge has not changed
  std::vector<SegmentPair> pairs_;  // in contact there, on current curves
  BoxTree tree_;
  std::vector<int> tree_segments_;  // of each box of the tree
  int tree_curves_ = 0;
  int tree_points_ = 0;
  SegmentTable part_;
  std::vector<SegmentPair> part_pairs_;
  int version_ = 0;
  double largest_coordinate_ = 0;
};

}  // namespace curvefusion
