#include "fusion/registration/overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Directions are measured over this many steps either way: raw skeletons zigzag by about a step.
constexpr int kDirectionSteps = 5;
constexpr int64_t kGrain = 64;

// The points of all edges of a graph in one array.
struct FlatGraph {
  explicit FlatGraph(const SkeletonGraph& source) : graph(source) {
    for (const EdgeId id : graph.Edges()) {
      const Polyline& curve = graph.edge(id).points;
      const std::vector<double> arcs = CumulativeLength(curve);
      const int n = static_cast<int>(curve.size());
      for (int i = 0; i < n; ++i) {
        const Vec3 along =
            curve[std::min(n - 1, i + kDirectionSteps)] - curve[std::max(0, i - kDirectionSteps)];
        points.push_back(curve[i]);
        edges.push_back(id);
        indices.push_back(i);
        arc_lengths.push_back(arcs[i]);
        rests.push_back(arcs.back() - arcs[i]);
        // A small closed curve has no direction over its whole length.
        directions.push_back(along.norm() > 0 ? along.normalized() : Vec3::Zero());
      }
    }
  }

  const SkeletonGraph& graph;
  std::vector<Vec3> points;
  std::vector<EdgeId> edges;
  std::vector<int> indices;
  std::vector<double> arc_lengths;  // from the first point of the edge
  std::vector<double> rests;        // to its last
  std::vector<Vec3> directions;
};

// Arc length between two points along their edge or over one shared node.
double Gap(const FlatGraph& flat, int i, int j) {
  double gap = std::numeric_limits<double>::infinity();
  if (flat.edges[i] == flat.edges[j]) gap = std::abs(flat.arc_lengths[i] - flat.arc_lengths[j]);
  const std::array<NodeId, 2>& nodes_i = flat.graph.edge(flat.edges[i]).nodes;
  const std::array<NodeId, 2>& nodes_j = flat.graph.edge(flat.edges[j]).nodes;
  const std::array<double, 2> from_i = {flat.arc_lengths[i], flat.rests[i]};
  const std::array<double, 2> from_j = {flat.arc_lengths[j], flat.rests[j]};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      if (nodes_i[a] == nodes_j[b] && !(flat.edges[i] == flat.edges[j] && a == b))
        gap = std::min(gap, from_i[a] + from_j[b]);
  return gap;
}

// A point on the polyline through a flat point, near p. Not a local one where the polyline comes
// nearer beyond the two segments at the flat point.
struct Projection {
  double parameter = 0;
  Vec3 point;
  bool is_local = true;
};

Projection ProjectAround(const FlatGraph& flat, int center, const Vec3& p) {
  const Polyline& curve = flat.graph.edge(flat.edges[center]).points;
  const int index = flat.indices[center];
  Projection nearest{static_cast<double>(index), curve[index]};
  for (int i = std::max(0, index - 1); i <= index && i + 1 < static_cast<int>(curve.size()); ++i) {
    const double t = ClosestParameter(curve[i], curve[i + 1], p);
    const Vec3 q = curve[i] + t * (curve[i + 1] - curve[i]);
    if ((q - p).squaredNorm() < (nearest.point - p).squaredNorm()) nearest = {i + t, q};
  }
  nearest.is_local = std::abs(nearest.parameter - index) < 1;
  return nearest;
}

class GraphMatcher {
 public:
  GraphMatcher(const SkeletonGraph& source, const SkeletonGraph& target, double step,
               const OverlapCriteria& criteria)
      : source_(source),
        target_(target),
        source_index_(source_.points),
        target_index_(target_.points),
        step_(step),
        criteria_(criteria),
        min_cosine_(std::cos(criteria.max_angle)) {}

  std::vector<Match> MatchAll() const {
    std::vector<Match> matches(source_.points.size());
    ParallelChunks(0, static_cast<int64_t>(matches.size()), kGrain,
                   [&](int64_t first, int64_t last) {
                     std::vector<int> found;
                     for (int64_t i = first; i < last; ++i)
                       matches[i] = MatchOne(static_cast<int>(i), found);
                   });
    return matches;
  }

  const FlatGraph& source() const { return source_; }

 private:
  bool SameDirection(const Vec3& a, const Vec3& b) const {
    return std::abs(a.dot(b)) >= min_cosine_;
  }

  // Whether a point lies beyond the end of the target curve it projects to. At a junction other
  // curves may go on there and match it; at a free end none does.
  bool IsBeyondEnd(const Vec3& p, int near, const Projection& projection) const {
    const SkeletonEdge& edge = target_.graph.edge(target_.edges[near]);
    for (int end = 0; end < 2; ++end) {
      const double last = static_cast<double>(edge.points.size() - 1);
      if (projection.parameter != (end == 0 ? 0.0 : last)) continue;
      const Vec3 outward = (end == 0 ? -1 : 1) * target_.directions[near];
      if (outward.dot(p - projection.point) > step_) return true;
    }
    return false;
  }

  Match MatchOne(int i, std::vector<int>& found) const {
    const Vec3& p = source_.points[i];
    Match match;
    int counterpart = -1;
    target_index_.WithinRadius(p, criteria_.distance + step_, found);
    double nearest = criteria_.distance;
    for (const int j : found) {
      const Projection projection = ProjectAround(target_, j, p);
      const double distance = (projection.point - p).norm();
      if (!projection.is_local || distance > criteria_.distance) continue;
      if (IsBeyondEnd(p, j, projection)) continue;
      match.is_near = true;
      if (distance > nearest || !SameDirection(source_.directions[i], target_.directions[j]))
        continue;
      if (counterpart >= 0 && distance == nearest) continue;
      nearest = distance;
      counterpart = j;
      match.edge = target_.edges[j];
      match.parameter = projection.parameter;
      match.distance = distance;
    }
    if (counterpart < 0) return match;
    if (criteria_.keep_neighbours && OtherFitsBetter(i, counterpart, nearest, found)) return {};
    return match;
  }

  // Whether some other part of the source is clearly nearer to the counterpart of a point.
  bool OtherFitsBetter(int i, int counterpart, double distance, std::vector<int>& found) const {
    const double limit = distance - criteria_.separation;
    if (limit <= 0) return false;
    const Vec3& q = target_.points[counterpart];
    source_index_.WithinRadius(q, limit, found);
    return std::any_of(found.begin(), found.end(), [&](int j) {
      return SameDirection(source_.directions[j], target_.directions[counterpart]) &&
             Gap(source_, i, j) > 2 * criteria_.distance;
    });
  }

  FlatGraph source_;
  FlatGraph target_;
  PointIndex source_index_;
  PointIndex target_index_;
  double step_;
  OverlapCriteria criteria_;
  double min_cosine_;
};

}  // namespace

std::vector<std::vector<Match>> MatchGraphs(const SkeletonGraph& source,
                                            const SkeletonGraph& target, double step,
                                            const OverlapCriteria& criteria) {
  const GraphMatcher matcher(source, target, step, criteria);
  const std::vector<Match> flat = matcher.MatchAll();
  const std::vector<EdgeId> edges = source.Edges();
  std::vector<std::vector<Match>> matches(edges.empty() ? 0 : edges.back() + 1);
  for (size_t i = 0; i < flat.size(); ++i) matches[matcher.source().edges[i]].push_back(flat[i]);
  return matches;
}

}  // namespace curvefusion
