#include "fusion/registration/overlap_merging.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// A displacement fades over this many times its length: bends of at most 14 degrees.
constexpr double kFade = 4;
// A run ends where the matches of neighbouring points jump by more points than this.
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

template <class T>
T ValueAt(const std::vector<T>& values, double index) {
  const size_t i = std::min(static_cast<size_t>(index), values.size() - 1);
  const size_t next = std::min(i + 1, values.size() - 1);
  return values[i] + (index - static_cast<double>(i)) * (values[next] - values[i]);
}

// What the bundle says about one point of the partial skeleton: sums over all runs.
struct Votes {
  Vec3 displacement = Vec3::Zero();
  double observations = 0;
  double count = 0;

  void Add(const Vec3& moved, double seen) {
    displacement += moved;
    observations += seen;
    count += 1;
  }
  void Add(const Votes& other) {
    displacement += other.displacement;
    observations += other.observations;
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
    votes[j].Add(ValueAt(bundle_edge.points, index) - partial_edge.points[j],
                 ValueAt(bundle_edge.observations, index));
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

double MeanObservations(const SkeletonGraph& graph, NodeId node) {
  double sum = 0;
  for (const EdgeId id : graph.IncidentEdges(node)) {
    const SkeletonEdge& edge = graph.edge(id);
    sum += edge.nodes[0] == node ? edge.observations.front() : edge.observations.back();
  }
  return sum / graph.Degree(node);
}

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
    votes[ours.nodes[i]].Add(displacement, MeanObservations(bundle, theirs.nodes[j]));
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

// The displacement of a point between two moved ones: that of both, fading with distance.
Vec3 Faded(const Vec3& left, const Vec3& right, double to_left, double to_right) {
  const auto fade = [gap = to_left + to_right](const Vec3& displacement, double distance) -> Vec3 {
    const double reach = std::min(kFade * displacement.norm(), gap);
    return distance < reach ? Vec3(displacement * (1 - distance / reach)) : Vec3::Zero();
  };
  return fade(left, to_left) + fade(right, to_right);
}

// Fills in the displacements of points that were not matched. Ends always count as known.
void FadeDisplacements(const Polyline& points, const std::vector<Votes>& votes,
                       std::vector<Vec3>& displacements) {
  const std::vector<double> arcs = CumulativeLength(points);
  size_t left = 0;
  for (size_t right = 1; right < points.size(); ++right) {
    if (right + 1 < points.size() && votes[right].count == 0) continue;
    for (size_t i = left + 1; i < right; ++i)
      displacements[i] = Faded(displacements[left], displacements[right], arcs[i] - arcs[left],
                               arcs[right] - arcs[i]);
    left = right;
  }
}

// Share of the bundle where `seen` observations meet `before`.
double BundleShare(const MergeWeights& weights, double before, double seen) {
  return weights.by_observation ? seen / std::max(1e-9, before + seen) : weights.bundle_share;
}

// Moves the points of an edge by their votes; its ends go where the nodes will be.
SkeletonEdge Averaged(SkeletonEdge edge, const std::vector<Votes>& votes,
                      const std::array<double, 2>& node_observations, const MergeWeights& weights) {
  std::vector<Vec3> displacements(edge.points.size(), Vec3::Zero());
  for (size_t i = 0; i < edge.points.size(); ++i) {
    if (votes[i].count == 0) continue;
    double before = edge.observations[i];
    if (i == 0) before = node_observations[0];
    if (i + 1 == edge.points.size()) before = node_observations[1];
    const double seen = votes[i].observations / votes[i].count;
    displacements[i] = BundleShare(weights, before, seen) * votes[i].displacement / votes[i].count;
    edge.observations[i] += seen;
  }
  FadeDisplacements(edge.points, votes, displacements);
  for (size_t i = 0; i < edge.points.size(); ++i) edge.points[i] += displacements[i];
  return edge;
}

}  // namespace

void AverageOverlaps(SkeletonGraph& partial, const SkeletonGraph& bundle,
                     const std::vector<std::vector<Match>>& matches, const MergeWeights& weights) {
  EdgeVotes votes = CollectVotes(partial, bundle, matches);
  ShareVotesAtNodes(partial, JunctionVotes(partial, bundle, weights.junction_distance), votes);
  std::map<NodeId, double> observations;
  for (const NodeId node : partial.Nodes())
    if (partial.Degree(node) > 0) observations[node] = MeanObservations(partial, node);
  std::map<EdgeId, SkeletonEdge> averaged;
  for (const EdgeId id : partial.Edges()) {
    const std::array<NodeId, 2>& nodes = partial.edge(id).nodes;
    averaged[id] = Averaged(partial.edge(id), votes[id],
                            {observations[nodes[0]], observations[nodes[1]]}, weights);
  }
  for (auto& [id, edge] : averaged) {
    // Every edge at a node computes the same place for it, bit for bit.
    partial.MoveNode(edge.nodes[0], edge.points.front());
    partial.MoveNode(edge.nodes[1], edge.points.back());
    partial.SetCurve(id, std::move(edge.points), std::move(edge.radii),
                     std::move(edge.observations));
  }
}

}  // namespace curvefusion
