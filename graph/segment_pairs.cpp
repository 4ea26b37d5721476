#include "graph/segment_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/box_pairs.h"

namespace curvefusion {

namespace {

// Sums of arc lengths are compared exactly where rounding might matter, so shortcuts that round
// leave this margin.
constexpr double kMargin = 1e-9;

double LeastOf(const LinearGap& way) {
  return std::min(way.s_at_a, way.s_at_b) + std::min(way.t_at_a, way.t_at_b);
}

double GreatestOf(const LinearGap& way) {
  return std::max(way.s_at_a, way.s_at_b) + std::max(way.t_at_a, way.t_at_b);
}

double SizeOf(const LinearGap& way) {
  return std::max(std::abs(way.s_at_a), std::abs(way.s_at_b)) +
         std::max(std::abs(way.t_at_a), std::abs(way.t_at_b));
}

void AddIfShort(const LinearGap& way, double reach, std::vector<LinearGap>& ways) {
  if (LeastOf(way) <= reach + kMargin * (reach + SizeOf(way))) ways.push_back(way);
}

// Whether there is a way at all between the curves of two segments, as there is between few.
bool HangTogether(const SegmentTable& table, const SegmentPair& pair) {
  const int curve_s = table.curves[pair.s];
  const int curve_t = table.curves[pair.t];
  if (curve_s == curve_t) return true;
  const auto& [a, b] = table.nodes[curve_s];
  const auto& [c, d] = table.nodes[curve_t];
  return a == c || a == d || b == c || b == d;
}

// Whether a segment is so near to an end of its curve that a way over the node there may be short.
bool MayReachNode(const SegmentTable& table, int k, double reach) {
  const double length = table.Length(table.curves[k]);
  const double limit = reach + kMargin * (reach + length);
  return table.arcs[k] <= limit || length - table.arcs[k + 1] <= limit;
}

void AddWaysOverNodes(const SegmentTable& table, const SegmentPair& pair, double reach,
                      std::vector<LinearGap>& ways) {
  const int curve_s = table.curves[pair.s];
  const int curve_t = table.curves[pair.t];
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (curve_s == curve_t && i == j) continue;
      if (table.nodes[curve_s][i] != table.nodes[curve_t][j]) continue;
      AddIfShort({table.FromEnd(pair.s, i), table.FromEnd(pair.s + 1, i), table.FromEnd(pair.t, j),
                  table.FromEnd(pair.t + 1, j)},
                 reach, ways);
    }
  }
}

// The points, by which side of each segment they are, that two segments share as a vertex of one
// curve or as a node.
struct SharedPoints {
  int count = 0;
  int side_s = 0;
  int side_t = 0;
};
SharedPoints FindSharedPoints(const SegmentTable& table, const SegmentPair& pair) {
  SharedPoints shared;
  if (table.curves[pair.s] == table.curves[pair.t] && pair.t == pair.s + 1) shared = {1, 1, 0};
  for (int i = 0; i < 2; ++i) {
    const NodeId node = table.NodeAt(pair.s, i);
    if (node < 0) continue;
    for (int j = 0; j < 2; ++j)
      if (table.NodeAt(pair.t, j) == node) shared = {shared.count + 1, i, j};
  }
  return shared;
}

// Whether two segments have a point in common other than one they share.
bool Meet(const SegmentTable& table, const SegmentPair& pair) {
  const SharedPoints shared = FindSharedPoints(table, pair);
  if (shared.count == 0) return Intersect(table.At(pair.s), table.At(pair.t));
  if (shared.count == 2) return true;  // straight segments between the same two points
  return Overlap(table.points[pair.s + shared.side_s], table.points[pair.s + 1 - shared.side_s],
                 table.points[pair.t + 1 - shared.side_t]);
}

bool AreOnOneShortWay(const std::vector<LinearGap>& ways, double reach) {
  return std::any_of(ways.begin(), ways.end(), [reach](const LinearGap& way) {
    return GreatestOf(way) < reach - kMargin * (reach + SizeOf(way));
  });
}

std::vector<int> SegmentsOf(const SegmentTable& table) {
  std::vector<int> segments;
  segments.reserve(table.points.size());
  for (int k = 0; k < table.point_count(); ++k)
    if (table.IsSegment(k)) segments.push_back(k);
  return segments;
}

// Boxes that overlap wherever segments come within the threshold.
Eigen::AlignedBox3d InflatedBox(const Segment& segment, double threshold) {
  const Vec3 largest = segment.a.cwiseAbs().cwiseMax(segment.b.cwiseAbs());
  const Vec3 margin = Vec3::Constant(threshold * (0.5 + kMargin)) + 1e-15 * largest;
  return {segment.a.cwiseMin(segment.b) - margin, segment.a.cwiseMax(segment.b) + margin};
}

// Pairs of an earlier table of which both curves were kept, in a table.
std::vector<SegmentPair> KeptPairs(const SegmentTable& earlier,
                                   const std::vector<SegmentPair>& pairs,
                                   const std::vector<int>& kept_curves, const SegmentTable& table) {
  std::vector<SegmentPair> kept;
  const auto segment_now = [&](int k) {
    const int now = kept_curves[earlier.curves[k]];
    return now < 0 ? -1 : table.first_points[now] + k - earlier.first_points[earlier.curves[k]];
  };
  for (const SegmentPair& pair : pairs) {
    const SegmentPair now{segment_now(pair.s), segment_now(pair.t)};
    if (now.s >= 0 && now.t >= 0) kept.push_back(now);
  }
  return kept;
}

// Those pairs in contact of which a segment is on a marked curve; all where none is marked.
std::vector<SegmentPair> MarkedPairs(const SegmentTable& table, double threshold,
                                     const std::vector<char>& marked_curves) {
  const std::vector<int> segments = SegmentsOf(table);
  std::vector<Eigen::AlignedBox3d> boxes;
  BoxPairFilter filter;
  boxes.reserve(segments.size());
  for (const int k : segments) {
    boxes.push_back(InflatedBox(table.At(k), threshold));
    if (!marked_curves.empty()) filter.marks.push_back(marked_curves[table.curves[k]]);
  }
  filter.keep = [&](int i, int j) {
    return AreInContact(table, {segments[i], segments[j]}, threshold);
  };
  std::vector<SegmentPair> pairs;
  for (const auto& [i, j] : OverlappingBoxes(boxes, filter))
    pairs.push_back({segments[i], segments[j]});
  return pairs;
}

}  // namespace

std::vector<LinearGap> ShortWays(const SegmentTable& table, const SegmentPair& pair, double reach) {
  std::vector<LinearGap> ways;
  const auto [s, t] = pair;
  if (table.curves[s] == table.curves[t])
    AddIfShort({-table.arcs[s], -table.arcs[s + 1], table.arcs[t], table.arcs[t + 1]}, reach, ways);
  if (MayReachNode(table, s, reach) && MayReachNode(table, t, reach))
    AddWaysOverNodes(table, pair, reach, ways);
  return ways;
}

bool AreInContact(const SegmentTable& table, const SegmentPair& pair, double threshold) {
  const double reach = kConnectedReach * threshold;
  std::vector<LinearGap> ways;
  if (HangTogether(table, pair)) ways = ShortWays(table, pair, reach);
  if (ways.empty()) return AreWithin(table.At(pair.s), table.At(pair.t), threshold);
  if (Meet(table, pair)) return true;
  if (threshold <= 0 || AreOnOneShortWay(ways, reach)) return false;
  return AreWithinBeyond(table.At(pair.s), table.At(pair.t), threshold, ways, reach);
}

std::vector<SegmentPair> SegmentPairsInContact(const SegmentTable& table, double threshold) {
  return MarkedPairs(table, threshold, {});
}

std::vector<SegmentPair> SegmentPairsInContact(const SegmentTable& table, double threshold,
                                               const SegmentTable& earlier,
                                               const std::vector<SegmentPair>& earlier_pairs) {
  const std::vector<int> kept_curves = table.NumbersOf(earlier);
  std::vector<char> has_changed(table.edges.size(), true);
  for (const int curve : kept_curves)
    if (curve >= 0) has_changed[curve] = false;
  std::vector<SegmentPair> pairs = KeptPairs(earlier, earlier_pairs, kept_curves, table);
  const std::vector<SegmentPair> changed = MarkedPairs(table, threshold, has_changed);
  const auto kept_count = static_cast<std::ptrdiff_t>(pairs.size());
  pairs.insert(pairs.end(), changed.begin(), changed.end());
  std::inplace_merge(pairs.begin(), pairs.begin() + kept_count, pairs.end());
  return pairs;
}

}  // namespace curvefusion
