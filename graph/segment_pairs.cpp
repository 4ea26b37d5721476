#include "graph/segment_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <utility>

namespace curvefusion {

namespace {

// Sums of arc lengths are compared exactly where rounding might matter, so shortcuts that round
// leave this margin. Chosen: far above the rounding of such sums.
constexpr double kMargin = 1e-9;

double LeastOf(const LinearGap& path) {
  return std::min(path.s_at_a, path.s_at_b) + std::min(path.t_at_a, path.t_at_b);
}

double GreatestOf(const LinearGap& path) {
  return std::max(path.s_at_a, path.s_at_b) + std::max(path.t_at_a, path.t_at_b);
}

double SizeOf(const LinearGap& path) {
  return std::max(std::abs(path.s_at_a), std::abs(path.s_at_b)) +
         std::max(std::abs(path.t_at_a), std::abs(path.t_at_b));
}

// One along a common curve and one for each pair of ends that may be one node.
using Paths = boost::container::static_vector<LinearGap, 5>;

void AddIfShort(const LinearGap& path, double reach, Paths& paths) {
  if (LeastOf(path) <= reach + kMargin * (reach + SizeOf(path))) paths.push_back(path);
}

// Whether there is a path at all between the curves of two segments, as there is between few.
bool HangTogether(const SegmentTable& table, const SegmentPair& pair) {
  const int curve_s = table.curve_of[pair.s];
  const int curve_t = table.curve_of[pair.t];
  if (curve_s == curve_t) return true;
  const auto& [a, b] = table.curves[curve_s].nodes;
  const auto& [c, d] = table.curves[curve_t].nodes;
  return a == c || a == d || b == c || b == d;
}

// Whether a segment is so near to an end of its curve that a path over the node there may be short.
bool MayReachNode(const SegmentTable& table, int k, double reach) {
  const double length = table.Length(table.curve_of[k]);
  const double limit = reach + kMargin * (reach + length);
  return table.points[k].arc_length <= limit || length - table.points[k + 1].arc_length <= limit;
}

void AddPathsOverNodes(const SegmentTable& table, const SegmentPair& pair, double reach,
                       Paths& paths) {
  const int curve_s = table.curve_of[pair.s];
  const int curve_t = table.curve_of[pair.t];
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (curve_s == curve_t && i == j) continue;
      if (table.curves[curve_s].nodes[i] != table.curves[curve_t].nodes[j]) continue;
      AddIfShort({table.FromEnd(pair.s, i), table.FromEnd(pair.s + 1, i), table.FromEnd(pair.t, j),
                  table.FromEnd(pair.t + 1, j)},
                 reach, paths);
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
  if (table.curve_of[pair.s] == table.curve_of[pair.t] && pair.t == pair.s + 1) shared = {1, 1, 0};
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
  return Overlap(table.points[pair.s + shared.side_s].position,
                 table.points[pair.s + 1 - shared.side_s].position,
                 table.points[pair.t + 1 - shared.side_t].position);
}

Paths FindShortPaths(const SegmentTable& table, const SegmentPair& pair, double reach) {
  Paths paths;
  const auto [s, t] = pair;
  if (table.curve_of[s] == table.curve_of[t])
    AddIfShort({-table.points[s].arc_length, -table.points[s + 1].arc_length,
                table.points[t].arc_length, table.points[t + 1].arc_length},
               reach, paths);
  if (MayReachNode(table, s, reach) && MayReachNode(table, t, reach))
    AddPathsOverNodes(table, pair, reach, paths);
  return paths;
}

bool AreOnOneShortPath(const Paths& paths, double reach) {
  return std::any_of(paths.begin(), paths.end(), [reach](const LinearGap& path) {
    return GreatestOf(path) < reach - kMargin * (reach + SizeOf(path));
  });
}

// The segments of the curves from one on that are marked; of all where there are no marks.
std::vector<int> SegmentsFrom(const SegmentTable& table, int first_curve,
                              const std::vector<char>& marks = {}) {
  std::vector<int> segments;
  segments.reserve(table.point_count() - table.first_points[first_curve]);
  for (int curve = first_curve; curve < table.curve_count(); ++curve) {
    if (!marks.empty() && !marks[curve]) continue;
    for (int k = table.first_points[curve]; k + 1 < table.first_points[curve + 1]; ++k)
      segments.push_back(k);
  }
  return segments;
}

// Boxes that overlap wherever segments come within the threshold.
Eigen::AlignedBox3d InflatedBox(const Segment& segment, double threshold) {
  const Vec3 largest = segment.a.cwiseAbs().cwiseMax(segment.b.cwiseAbs());
  const Vec3 margin = Vec3::Constant(threshold * (0.5 + kMargin)) + 1e-15 * largest;
  return {segment.a.cwiseMin(segment.b) - margin, segment.a.cwiseMax(segment.b) + margin};
}

std::vector<Eigen::AlignedBox3d> InflatedBoxes(const SegmentTable& table,
                                               const std::vector<int>& segments, double threshold) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(segments.size());
  for (const int k : segments) boxes.push_back(InflatedBox(table.At(k), threshold));
  return boxes;
}

// Pairs of the boxes of a tree as pairs of the segments that they are of.
std::vector<SegmentPair> PairsOfSegments(const BoxTree::Pairs& boxes, const std::vector<int>& s,
                                         const std::vector<int>& t) {
  std::vector<SegmentPair> pairs;
  pairs.reserve(boxes.size());
  for (const auto& [i, j] : boxes) pairs.push_back({s[i], t[j]});
  return pairs;
}

// Pairs of boxes come in no order of memory: what is needed of the table so many pairs later is
// fetched in time. Chosen: only the time depends on it.
constexpr size_t kLookahead = 8;

void FetchPoints(const SegmentTable& table, int s) {
  __builtin_prefetch(&table.curve_of[s]);
  __builtin_prefetch(&table.points[s]);
  __builtin_prefetch(&table.points[s + 1]);
}

void FetchCurve(const SegmentTable& table, int s) {
  __builtin_prefetch(&table.curves[table.curve_of[s]]);
}

// Keeps those pairs of boxes i and j for which keep(segments i, segments j) holds.
template <class Keep>
void KeepPairs(const SegmentTable& table, const std::vector<int>& segments_i,
               const std::vector<int>& segments_j, BoxTree::Pairs& boxes, const Keep& keep) {
  std::vector<SegmentPair> pairs = PairsOfSegments(boxes, segments_i, segments_j);
  size_t kept = 0;
  for (size_t n = 0; n < pairs.size(); ++n) {
    if (n + 2 * kLookahead < pairs.size()) {
      FetchPoints(table, pairs[n + 2 * kLookahead].s);
      FetchPoints(table, pairs[n + 2 * kLookahead].t);
    }
    if (n + kLookahead < pairs.size()) {
      FetchCurve(table, pairs[n + kLookahead].s);
      FetchCurve(table, pairs[n + kLookahead].t);
    }
    if (keep(pairs[n])) boxes[kept++] = boxes[n];
  }
  boxes.resize(kept);
}

std::vector<SegmentPair> PairsInTree(const BoxTree& tree, const std::vector<int>& segments,
                                     const SegmentTable& table, double threshold) {
  const auto filter = [&](BoxTree::Pairs& boxes) {
    KeepPairs(table, segments, segments, boxes,
              [&](const SegmentPair& pair) { return AreInContact(table, pair, threshold); });
  };
  return PairsOfSegments(tree.OverlappingPairs(filter), segments, segments);
}

}  // namespace

std::vector<LinearGap> ShortPaths(const SegmentTable& table, const SegmentPair& pair,
                                  double reach) {
  const Paths paths = FindShortPaths(table, pair, reach);
  return {paths.begin(), paths.end()};
}

bool AreInContact(const SegmentTable& table, const SegmentPair& pair, double threshold) {
  const double reach = kConnectedReach * threshold;
  Paths paths;
  if (HangTogether(table, pair)) paths = FindShortPaths(table, pair, reach);
  if (paths.empty()) return AreWithin(table.At(pair.s), table.At(pair.t), threshold);
  if (Meet(table, pair)) return true;
  if (threshold <= 0 || AreOnOneShortPath(paths, reach)) return false;
  return AreWithinBeyond(table.At(pair.s), table.At(pair.t), threshold,
                         {paths.begin(), paths.end()}, reach);
}

std::vector<SegmentPair> SegmentPairsInContact(const SegmentTable& table, double threshold) {
  const std::vector<int> segments = SegmentsFrom(table, 0);
  return PairsInTree(BoxTree(InflatedBoxes(table, segments, threshold)), segments, table,
                     threshold);
}

void SegmentPairSearch::Update(const SkeletonGraph& graph) {
  const std::vector<EdgeId> changed = graph.Edges(version_);
  version_ = graph.version();
  size_t count = table_.points.size();
  for (const EdgeId id : changed) count += graph.edge(id).points.size();
  if (static_cast<double>(count) > (1 + SegmentTable::kRoom) * tree_points_) {
    Restart(graph);
  } else {
    DropChanged(graph);
    Extend(graph, changed);
    CollectPart(graph);
  }
  largest_coordinate_ = LargestOfCurrent();
}

void SegmentPairSearch::Restart(const SkeletonGraph& graph) {
  table_ = SegmentTable();  // the memory is needed for the new ones
  tree_ = BoxTree();
  table_ = SegmentTable(graph);
  is_current_.assign(table_.curves.size(), true);
  tree_segments_ = SegmentsFrom(table_, 0);
  tree_ = BoxTree(InflatedBoxes(table_, tree_segments_, threshold_));
  tree_curves_ = table_.curve_count();
  tree_points_ = table_.point_count();
  pairs_ = PairsInTree(tree_, tree_segments_, table_, threshold_);
}

void SegmentPairSearch::DropChanged(const SkeletonGraph& graph) {
  for (int curve = 0; curve < table_.curve_count(); ++curve)
    is_current_[curve] = is_current_[curve] &&
                         graph.version(table_.curves[curve].edge) == table_.curves[curve].version;
  std::erase_if(pairs_, [&](const SegmentPair& pair) {
    return !is_current_[table_.curve_of[pair.s]] || !is_current_[table_.curve_of[pair.t]];
  });
}

void SegmentPairSearch::Extend(const SkeletonGraph& graph, const std::vector<EdgeId>& changed) {
  const int first_curve = table_.curve_count();
  const int first_point = table_.point_count();
  table_.Append(graph, changed);
  is_current_.resize(table_.curves.size(), true);
  const std::vector<int> added = SegmentsFrom(table_, first_curve);
  const auto keep = [&](BoxTree::Pairs& boxes) {
    KeepPairs(table_, tree_segments_, added, boxes, [&](const SegmentPair& pair) {
      return is_current_[table_.curve_of[pair.s]] && AreInContact(table_, pair, threshold_);
    });
  };
  std::vector<SegmentPair> found =
      PairsOfSegments(tree_.OverlappingPairs(InflatedBoxes(table_, added, threshold_), keep),
                      tree_segments_, added);
  pairs_.insert(pairs_.end(), found.begin(), found.end());
  const std::vector<int> extension = SegmentsFrom(table_, tree_curves_, is_current_);
  const auto keep_new = [&](BoxTree::Pairs& boxes) {
    KeepPairs(table_, extension, extension, boxes, [&](const SegmentPair& pair) {
      return pair.t >= first_point && AreInContact(table_, pair, threshold_);
    });
  };
  found = PairsOfSegments(
      BoxTree(InflatedBoxes(table_, extension, threshold_)).OverlappingPairs(keep_new), extension,
      extension);
  pairs_.insert(pairs_.end(), found.begin(), found.end());
}

void SegmentPairSearch::CollectPart(const SkeletonGraph& graph) {
  std::vector<EdgeId> edges;
  for (const SegmentPair& pair : pairs_)
    for (const int k : {pair.s, pair.t}) edges.push_back(table_.curves[table_.curve_of[k]].edge);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  part_ = SegmentTable(graph, edges);
  const auto number = [&](int k) {
    const int curve = table_.curve_of[k];
    const auto at = std::lower_bound(edges.begin(), edges.end(), table_.curves[curve].edge);
    return part_.first_points[at - edges.begin()] + k - table_.first_points[curve];
  };
  part_pairs_.clear();
  for (const SegmentPair& pair : pairs_) {
    const auto [s, t] = std::minmax({number(pair.s), number(pair.t)});
    part_pairs_.push_back({s, t});
  }
  std::sort(part_pairs_.begin(), part_pairs_.end());
}

double SegmentPairSearch::LargestOfCurrent() const {
  double largest = 0;
  for (int curve = 0; curve < table_.curve_count(); ++curve)
    if (is_current_[curve]) largest = std::max(largest, table_.curves[curve].largest_coordinate);
  return largest;
}

}  // namespace curvefusion
