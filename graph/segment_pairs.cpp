#include "graph/segment_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>

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

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

std::vector<Box> InflatedBoxes(const SegmentTable& table, double threshold) {
  std::vector<Box> boxes;
  boxes.reserve(table.points.size());
  for (int k = 0; k < table.point_count(); ++k) {
    if (!table.IsSegment(k)) continue;
    const Vec3& a = table.points[k];
    const Vec3& b = table.points[k + 1];
    const Vec3 largest = a.cwiseAbs().cwiseMax(b.cwiseAbs());
    const Vec3 margin = Vec3::Constant(threshold * (0.5 + kMargin)) + 1e-15 * largest;
    Vec3 low = a.cwiseMin(b) - margin;
    Vec3 high = a.cwiseMax(b) + margin;
    boxes.emplace_back(low.data(), high.data(), k);
  }
  return boxes;
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
  const std::vector<LinearGap> ways = ShortWays(table, pair, reach);
  if (ways.empty()) return AreWithin(table.At(pair.s), table.At(pair.t), threshold);
  if (Meet(table, pair)) return true;
  if (threshold <= 0 || AreOnOneShortWay(ways, reach)) return false;
  return AreWithinBeyond(table.At(pair.s), table.At(pair.t), threshold, ways, reach);
}

std::vector<SegmentPair> SegmentPairsInContact(const SegmentTable& table, double threshold) {
  std::vector<Box> boxes = InflatedBoxes(table, threshold);
  std::vector<SegmentPair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const SegmentPair pair{std::min(a.info(), b.info()), std::max(a.info(), b.info())};
    if (AreInContact(table, pair, threshold)) pairs.push_back(pair);
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace curvefusion
