#include "fusion/paper/overlap_averaging.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// A run ends where the matches of neighbouring points jump by more points than this. Chosen: 10
// points of 1 mm are the 1 cm within which curves overlap (CurveFusion 4.3).
constexpr double kMaxJump = 10;

// Consecutive points of one bundle edge that match one edge of the partial skeleton.
struct Run {
  size_t first;
  size_t last;
};

std::vector<Run> RunsOf(const std::vector<Match>& matches) {
  std::vector<Run> runs;
  for (size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].edge < 0) continue;
    const bool continues = !runs.empty() && runs.back().last + 1 == i &&
                           matches[i - 1].edge == matches[i].edge &&
                           std::abs(matches[i].parameter - matches[i - 1].parameter) <= kMaxJump;
    if (continues) {
      runs.back().last = i;
    } else {
      runs.push_back({i, i});
    }
  }
  return runs;
}

// A step of a monotone relation: the mean of `count` values of y, and of their x.
struct Level {
  double x;
  double y;
  double count;
};

// The nearest non-decreasing sequence to y (pool adjacent violators), as levels of ascending y.
std::vector<Level> IsotonicLevels(const std::vector<double>& y) {
  std::vector<Level> levels;
  for (size_t i = 0; i < y.size(); ++i) {
    levels.push_back({static_cast<double>(i), y[i], 1});
    while (levels.size() > 1 && levels[levels.size() - 2].y >= levels.back().y) {
      const Level top = levels.back();
      levels.pop_back();
      Level& below = levels.back();
      const double count = below.count + top.count;
      below = {(below.count * below.x + top.count * top.x) / count,
               (below.count * below.y + top.count * top.y) / count, count};
    }
  }
  return levels;
}

// x at a value of y between the first and the last level.
double Inverse(const std::vector<Level>& levels, double y) {
  const auto above = std::lower_bound(levels.begin(), levels.end(), y,
                                      [](const Level& level, double v) { return level.y < v; });
  if (above == levels.begin()) return above->x;
  const auto below = above - 1;
  return below->x + (above->x - below->x) * (y - below->y) / (above->y - below->y);
}

Vec3 PointAtIndex(const Polyline& points, double index) {
  const size_t i = std::min(static_cast<size_t>(index), points.size() - 1);
  const size_t next = std::min(i + 1, points.size() - 1);
  return points[i] + (index - static_cast<double>(i)) * (points[next] - points[i]);
}

// What the bundle says about one point of the partial skeleton: sums over all runs.
struct Votes {
  Vec3 displacement = Vec3::Zero();
  double count = 0;

  void Add(const Votes& other) {
    displacement += other.displacement;
    count += other.count;
  }
};

using EdgeVotes = std::map<EdgeId, std::vector<Votes>>;

// Lets one run vote for the points it passes.
void Vote(const SkeletonEdge& bundle_edge, const std::vector<Match>& matches, const Run& run,
          const SkeletonEdge& partial_edge, std::vector<Votes>& votes) {
  const double sign = matches[run.last].parameter >= matches[run.first].parameter ? 1 : -1;
  std::vector<double> parameters;
  for (size_t i = run.first; i <= run.last; ++i) parameters.push_back(sign * matches[i].parameter);
  const std::vector<Level> levels = IsotonicLevels(parameters);
  const double low = std::min(sign * levels.front().y, sign * levels.back().y);
  const double high = std::max(sign * levels.front().y, sign * levels.back().y);
  for (int j = static_cast<int>(std::ceil(low)); j <= static_cast<int>(std::floor(high)); ++j) {
    const double index = static_cast<double>(run.first) + Inverse(levels, sign * j);
    votes[j].Add({PointAtIndex(bundle_edge.points, index) - partial_edge.points[j], 1});
  }
}

EdgeVotes CollectVotes(const SkeletonGraph& partial, const SkeletonGraph& bundle,
                       const std::vector<std::vector<Match>>& matches) {
  EdgeVotes votes;
  for (const EdgeId id : partial.Edges()) votes[id].resize(partial.edge(id).points.size());
  for (const EdgeId id : bundle.Edges()) {
    for (const Run& run : RunsOf(matches[id])) {
      const EdgeId target = matches[id][run.first].edge;
      Vote(bundle.edge(id), matches[id], run, partial.edge(target), votes[target]);
    }
  }
  return votes;
}

struct Junctions {
  explicit Junctions(const SkeletonGraph& graph) {
    for (const NodeId node : graph.Nodes()) {
      if (graph.Degree(node) < 3) continue;
      nodes.push_back(node);
      positions.push_back(graph.position(node));
    }
  }
  std::vector<NodeId> nodes;
  std::vector<Vec3> positions;
};

// Pairs of junctions, each the other's nearest: what the one of the bundle says about its partner.
std::map<NodeId, Votes> JunctionVotes(const SkeletonGraph& partial, const SkeletonGraph& bundle,
                                      double distance) {
  const Junctions ours(partial);
  const Junctions theirs(bundle);
  const PointIndex our_index(ours.positions);
  const PointIndex their_index(theirs.positions);
  std::map<NodeId, Votes> votes;
  for (size_t i = 0; i < ours.nodes.size(); ++i) {
    const int j = their_index.Nearest(ours.positions[i]);
    if (j < 0 || our_index.Nearest(theirs.positions[j]) != static_cast<int>(i)) continue;
    const Vec3 displacement = theirs.positions[j] - ours.positions[i];
    if (displacement.norm() > distance) continue;
    votes[ours.nodes[i]].Add({displacement, 1});
  }
  return votes;
}

// The ends of edges at a node are one point: they share their votes; pairs of junctions come first.
void ShareVotesAtNodes(const SkeletonGraph& partial, const std::map<NodeId, Votes>& junction_votes,
                       EdgeVotes& votes) {
  std::map<NodeId, Votes> of_node = junction_votes;
  for (const EdgeId id : partial.Edges()) {
    for (int end = 0; end < 2; ++end) {
      const NodeId node = partial.edge(id).nodes[end];
      if (junction_votes.count(node) > 0) continue;
      of_node[node].Add(end == 0 ? votes[id].front() : votes[id].back());
    }
  }
  for (const EdgeId id : partial.Edges()) {
    votes[id].front() = of_node[partial.edge(id).nodes[0]];
    votes[id].back() = of_node[partial.edge(id).nodes[1]];
  }
}

// Moves the points of an edge by their votes; its ends go where the nodes will be.
SkeletonEdge Averaged(SkeletonEdge edge, const std::vector<Votes>& votes, double bundle_weight) {
  for (size_t i = 0; i < edge.points.size(); ++i) {
    if (votes[i].count == 0) continue;
    edge.points[i] += bundle_weight * votes[i].displacement / votes[i].count;
  }
  return edge;
}

}  // namespace

void AverageOverlaps(SkeletonGraph& partial, const SkeletonGraph& bundle,
                     const std::vector<std::vector<Match>>& matches, const MergeWeights& weights) {
  EdgeVotes votes = CollectVotes(partial, bundle, matches);
  ShareVotesAtNodes(partial, JunctionVotes(partial, bundle, weights.junction_distance), votes);
  std::map<EdgeId, SkeletonEdge> averaged;
  for (const EdgeId id : partial.Edges()) {
    averaged[id] = Averaged(partial.edge(id), votes[id], weights.bundle_weight);
  }
  for (auto& [id, edge] : averaged) {
    // Every edge at a node computes the same place for it, bit for bit.
    partial.MoveNode(edge.nodes[0], edge.points.front());
    partial.MoveNode(edge.nodes[1], edge.points.back());
    partial.SetCurve(id, std::move(edge.points));
  }
}

}  // namespace curvefusion
