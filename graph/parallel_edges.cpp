#include "graph/parallel_edges.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "graph/edge_curve.h"
#include "graph/frechet_matching.h"

namespace curvefusion {

namespace {

// Nodes of edges are fetched from memory so many edges ahead. Chosen: only the time
// depends on it.
constexpr size_t kLookahead = 12;

double Weight(const SkeletonEdge& edge) {
  if (edge.observations.empty()) return 1;
  const double sum = std::accumulate(edge.observations.begin(), edge.observations.end(), 0.0);
  return std::max(1e-6, sum / static_cast<double>(edge.observations.size()));
}

// Whether two edges between the same nodes run against each other; of two self-loops, the
// direction in which they stay nearer.
bool RunAgainst(const SkeletonEdge& a, const SkeletonEdge& b) {
  if (a.nodes[0] != a.nodes[1]) return a.nodes[0] != b.nodes[0];
  const Vec3 quarter = PointAt(a.points, CumulativeLength(a.points), Length(a.points) / 4);
  const std::vector<double> arcs = CumulativeLength(b.points);
  return (quarter - PointAt(b.points, arcs, arcs.back() * 3 / 4)).norm() <
         (quarter - PointAt(b.points, arcs, arcs.back() / 4)).norm();
}

// Where two edges between the same nodes are the same curve within a distance: the second, turned
// as the first runs, and its first place that goes with each point of the first.
struct SameCurve {
  SkeletonEdge other;
  std::vector<PolylinePlace> places;
};

// Self-loops may run either way.
std::optional<SameCurve> AsSameCurve(const SkeletonEdge& edge, SkeletonEdge other,
                                     double distance) {
  const bool is_loop = edge.nodes[0] == edge.nodes[1];
  if (RunAgainst(edge, other)) Reverse(other);
  for (int direction = 0; direction < (is_loop ? 2 : 1); ++direction) {
    if (direction > 0) Reverse(other);
    if (auto places = MatchInOrder(edge.points, other.points, distance))
      return SameCurve{std::move(other), std::move(*places)};
  }
  return std::nullopt;
}

// The values of `to` at the same fractions of the length as the points of `from`.
SkeletonEdge MatchAlongLength(const SkeletonEdge& from, const SkeletonEdge& to) {
  const std::vector<double> from_arcs = CumulativeLength(from.points);
  const std::vector<double> to_arcs = CumulativeLength(to.points);
  const double scale = from_arcs.back() > 0 ? to_arcs.back() / from_arcs.back() : 0;
  std::vector<double> at;
  at.reserve(from_arcs.size());
  for (const double arc : from_arcs) at.push_back(std::min(arc * scale, to_arcs.back()));
  return SampledAt(to, to_arcs, at);
}

SkeletonEdge MatchAtPlaces(const SkeletonEdge& to, const std::vector<PolylinePlace>& places) {
  const std::vector<double> arcs = CumulativeLength(to.points);
  std::vector<double> at;
  at.reserve(places.size());
  for (const auto& [segment, parameter] : places)
    at.push_back(arcs[segment] + parameter * (arcs[segment + 1] - arcs[segment]));
  return SampledAt(to, arcs, at);
}

void CopyValues(const SkeletonEdge& from, size_t i, SkeletonEdge& to) {
  to.points[i] = from.points[i];
  if (!to.radii.empty()) to.radii[i] = from.radii[i];
  if (!to.observations.empty()) to.observations[i] = from.observations[i];
}

// The values of the other curve that go with the points of an edge: those at the same share of the
// length or, where that is farther than the distance, at the first place that is not.
SkeletonEdge Matched(const SkeletonEdge& edge, const SameCurve& same, double distance) {
  SkeletonEdge matched = MatchAlongLength(edge, same.other);
  std::optional<SkeletonEdge> first;
  for (size_t i = 0; i < edge.points.size(); ++i) {
    if ((matched.points[i] - edge.points[i]).norm() <= distance) continue;
    if (!first) first = MatchAtPlaces(same.other, same.places);
    CopyValues(*first, i, matched);
  }
  return matched;
}

// The mean of two edges between the same nodes, on the points of the first.
SkeletonEdge MeanEdge(const SkeletonEdge& a, const SameCurve& b, double distance) {
  const double share = Weight(b.other) / (Weight(a) + Weight(b.other));
  const SkeletonEdge matched = Matched(a, b, distance);
  SkeletonEdge mean = a;
  if (mean.radii.empty()) mean.radii = matched.radii;
  for (size_t i = 0; i < mean.points.size(); ++i) {
    if (i > 0 && i + 1 < mean.points.size())
      mean.points[i] += share * (matched.points[i] - mean.points[i]);
    if (!matched.radii.empty()) mean.radii[i] += share * (matched.radii[i] - mean.radii[i]);
    if (!mean.observations.empty() && !matched.observations.empty())
      mean.observations[i] += matched.observations[i];
  }
  RemoveRepeatedPoints(mean);
  return mean;
}

// Every two edges with the same two nodes, by ascending handles, if one of them changed after a
// version.
std::vector<std::pair<EdgeId, EdgeId>> EdgesOfSameNodes(const SkeletonGraph& graph, int since) {
  std::vector<std::pair<EdgeId, EdgeId>> pairs;
  const std::vector<EdgeId> edges = graph.Edges(since);
  for (size_t i = 0; i < edges.size(); ++i) {
    if (i + kLookahead < edges.size())
      for (const NodeId node : graph.edge(edges[i + kLookahead]).nodes) graph.FetchNode(node);
    const EdgeId id = edges[i];
    const auto& [a, b] = graph.edge(id).nodes;
    const NodeId node = graph.Degree(a) <= graph.Degree(b) ? a : b;
    for (const EdgeId other : graph.IncidentEdges(node)) {
      const auto& [c, d] = graph.edge(other).nodes;
      if (other != id && std::minmax(a, b) == std::minmax(c, d))
        pairs.emplace_back(std::minmax(id, other));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<std::pair<EdgeId, EdgeId>> ParallelEdges(const SkeletonGraph& graph, double distance) {
  std::vector<std::pair<EdgeId, EdgeId>> parallel;
  for (const auto& [a, b] : EdgesOfSameNodes(graph, 0))
    if (AsSameCurve(graph.edge(a), graph.edge(b), distance)) parallel.emplace_back(a, b);
  return parallel;
}

void MergeParallelEdges(SkeletonGraph& graph, double distance, int since) {
  for (const auto& [a, b] : EdgesOfSameNodes(graph, since)) {
    if (!graph.HasEdge(a) || !graph.HasEdge(b)) continue;
    const auto same = AsSameCurve(graph.edge(a), graph.edge(b), distance);
    if (!same) continue;
    SkeletonEdge mean = MeanEdge(graph.edge(a), *same, distance);
    graph.RemoveEdge(b);
    graph.SetCurve(a, std::move(mean.points), std::move(mean.radii), std::move(mean.observations));
  }
}

}  // namespace curvefusion
