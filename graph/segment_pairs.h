#pragma once

#include <vector>

#include "graph/segment_table.h"

namespace curvefusion {

/// Arc length in thresholds over which two parts of the graph that hang together may stay near each
/// other: arms of a fork of more than 20 degrees have parted by then.
inline constexpr double kConnectedReach = 6;

/// Two segments of a table, s < t.
struct SegmentPair {
  int s;
  int t;
  auto operator<=>(const SegmentPair&) const = default;
};

/// The ways along the graph between two segments, along their common curve or over one common node,
/// on which some of their points are nearer to each other than `reach`.
std::vector<LinearGap> ShortWays(const SegmentTable& table, const SegmentPair& pair, double reach);

/// All pairs of segments in contact, ascending. Two segments are in contact where
/// - they have a point in common other than a node or a vertex they share, or
/// - they have points within the threshold (limit included) of each other between which every way,
///   along the common curve or over one common node, is at least kConnectedReach thresholds long;
///   this applies to thresholds above zero.
/// Decided exactly on the stored coordinates and on arc lengths as the table has them. No segment
/// may have length zero. O(n log n + k) in segments and in pairs whose boxes meet.
std::vector<SegmentPair> SegmentPairsInContact(const SegmentTable& table, double threshold);

/// The same, given the pairs in contact of an earlier state of the graph at the same threshold.
/// Whether two segments are in contact depends on their own edges only, so pairs on edges that have
/// not changed need not be decided again.
std::vector<SegmentPair> SegmentPairsInContact(const SegmentTable& table, double threshold,
                                               const SegmentTable& earlier,
                                               const std::vector<SegmentPair>& earlier_pairs);

/// Whether one pair is in contact.
bool AreInContact(const SegmentTable& table, const SegmentPair& pair, double threshold);

}  // namespace curvefusion
