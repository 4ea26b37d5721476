#include "fusion/paper/curve_overlap.h"

#include <algorithm>
#include <cmath>

#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Directions are taken over this many steps either way. Chosen: raw skeletons zigzag by about a
// step.
constexpr int kDirectionSteps = 5;
// Curves cross rather than overlap where their directions differ by more than 0.6 rad. Chosen: the
// paper has no such limit, but curves that meet in a junction are near one another too.
constexpr double kMinCosine = 0.825;
constexpr int64_t kGrain = 64;

// The points of all edges of a graph in one array.
struct FlatGraph {
  explicit FlatGraph(const SkeletonGraph& source) : graph(source) {
    for (const EdgeId id : graph.Edges()) {
      const Polyline& curve = graph.edge(id).points;
      const int n = static_cast<int>(curve.size());
      for (int i = 0; i < n; ++i) {
        const Vec3 along =
            curve[std::min(n - 1, i + kDirectionSteps)] - curve[std::max(0, i - kDirectionSteps)];
        points.push_back(curve[i]);
        edges.push_back(id);
        indices.push_back(i);
        // A small closed curve has no direction over its whole length.
        directions.push_back(along.norm() > 0 ? along.normalized() : Vec3::Zero());
      }
    }
  }

  const SkeletonGraph& graph;
  std::vector<Vec3> points;
  std::vector<EdgeId> edges;
  std::vector<int> indices;
  std::vector<Vec3> directions;
};

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
               double distance)
      : source_(source),
        target_(target),
        target_index_(target_.points),
        step_(step),
        distance_(distance) {}

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
    return std::abs(a.dot(b)) >= kMinCosine;
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
    target_index_.WithinRadius(p, distance_ + step_, found);
    double nearest = distance_;
    for (const int j : found) {
      const Projection projection = ProjectAround(target_, j, p);
      const double distance = (projection.point - p).norm();
      if (!projection.is_local || distance > distance_) continue;
      if (IsBeyondEnd(p, j, projection)) continue;
      match.is_near = true;
      if (distance > nearest || !SameDirection(source_.directions[i], target_.directions[j]))
        continue;
      if (match.edge >= 0 && distance == nearest) continue;
      nearest = distance;
      match.edge = target_.edges[j];
      match.parameter = projection.parameter;
      match.distance = distance;
    }
    return match;
  }

  FlatGraph source_;
  FlatGraph target_;
  PointIndex target_index_;
  double step_;
  double distance_;
};

}  // namespace

std::vector<std::vector<Match>> MatchGraphs(const SkeletonGraph& source,
                                            const SkeletonGraph& target, double step,
                                            double distance) {
  const GraphMatcher matcher(source, target, step, distance);
  const std::vector<Match> flat = matcher.MatchAll();
  const std::vector<EdgeId> edges = source.Edges();
  std::vector<std::vector<Match>> matches(edges.empty() ? 0 : edges.back() + 1);
  for (size_t i = 0; i < flat.size(); ++i) matches[matcher.source().edges[i]].push_back(flat[i]);
  return matches;
}

}  // namespace curvefusion
