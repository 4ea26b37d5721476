#include "graph/merge.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>

#include "graph/contacts.h"
#include "graph/edge_curve.h"
#include "graph/junctions.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr int kMaxRounds = 8;
// Curves that were joined at both ends of a stretch within the threshold may part a little between.
constexpr double kParallelSlack = 1.5;

bool StaysWithin(const Polyline& points, const Polyline& other, double distance) {
  return std::all_of(points.begin(), points.end(), [&other, distance](const Vec3& p) {
    return Project(other, p).distance <= distance;
  });
}

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

// The values of `to` at the same fractions of the length as the points of `from`.
struct MatchedCurve {
  Polyline points;
  std::vector<double> radii;
  std::vector<double> observations;
};
MatchedCurve MatchAlongLength(const SkeletonEdge& from, const SkeletonEdge& to) {
  const std::vector<double> from_arcs = CumulativeLength(from.points);
  const std::vector<double> to_arcs = CumulativeLength(to.points);
  MatchedCurve matched;
  for (const double arc : from_arcs) {
    const double at = to_arcs.back() * (arc / from_arcs.back());
    const SkeletonEdge here = PartOfEdge(to, to_arcs, at, at);
    matched.points.push_back(here.points.front());
    if (!here.radii.empty()) matched.radii.push_back(here.radii.front());
    if (!here.observations.empty()) matched.observations.push_back(here.observations.front());
  }
  return matched;
}

// The mean of two edges between the same nodes, on the points of the first.
SkeletonEdge MeanEdge(const SkeletonEdge& a, SkeletonEdge b) {
  if (RunAgainst(a, b)) Reverse(b);
  const double share = Weight(b) / (Weight(a) + Weight(b));
  const MatchedCurve matched = MatchAlongLength(a, b);
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

// Every two edges with the same two nodes, by ascending handles.
std::vector<std::pair<EdgeId, EdgeId>> EdgesOfSameNodes(const SkeletonGraph& graph) {
  std::map<std::array<NodeId, 2>, std::vector<EdgeId>> edges_of_nodes;
  for (const EdgeId id : graph.Edges()) {
    std::array<NodeId, 2> nodes = graph.edge(id).nodes;
    std::sort(nodes.begin(), nodes.end());
    edges_of_nodes[nodes].push_back(id);
  }
  std::vector<std::pair<EdgeId, EdgeId>> pairs;
  for (const auto& entry : edges_of_nodes)
    for (size_t i = 0; i < entry.second.size(); ++i)
      for (size_t j = i + 1; j < entry.second.size(); ++j)
        pairs.emplace_back(entry.second[i], entry.second[j]);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Pairs of junctions within a distance, nearest first.
std::vector<std::tuple<double, int, int>> NearPairs(const std::vector<Vec3>& positions,
                                                    double distance) {
  const PointIndex index(positions);
  std::vector<std::tuple<double, int, int>> pairs;
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(positions.size()); ++i) {
    index.WithinRadius(positions[i], distance, found);
    for (const int j : found)
      if (j > i) pairs.emplace_back((positions[i] - positions[j]).norm(), i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Short edges of a graph, shortest first.
std::vector<EdgeId> ShortEdges(const SkeletonGraph& graph, double length) {
  std::vector<std::pair<double, EdgeId>> found;
  for (const EdgeId id : graph.Edges()) {
    const double edge_length = Length(graph.edge(id).points);
    if (edge_length < length) found.emplace_back(edge_length, id);
  }
  std::sort(found.begin(), found.end());
  std::vector<EdgeId> edges;
  for (const auto& entry : found) edges.push_back(entry.second);
  return edges;
}

bool IsDangling(const SkeletonGraph& graph, const SkeletonEdge& edge) {
  return graph.Degree(edge.nodes[0]) == 1 || graph.Degree(edge.nodes[1]) == 1;
}

// Shrinks short links to one node each; of links that share a node only the shortest.
void ContractLinks(SkeletonGraph& graph, const std::vector<EdgeId>& links, double length) {
  std::vector<NodeGroup> groups;
  std::vector<NodeId> touched;
  for (const EdgeId id : links) {
    const std::array<NodeId, 2> nodes = graph.edge(id).nodes;
    const bool is_free = std::none_of(nodes.begin(), nodes.end(), [&touched](NodeId node) {
      return std::binary_search(touched.begin(), touched.end(), node);
    });
    if (!is_free) continue;
    NodeGroup group;
    for (const NodeId node : nodes) {
      group.nodes.push_back(node);
      group.weights.push_back(graph.Degree(node));
      touched.insert(std::upper_bound(touched.begin(), touched.end(), node), node);
    }
    groups.push_back(std::move(group));
  }
  MergeNodeGroups(graph, groups, length);
}

}  // namespace

void MergeNearbyJunctions(SkeletonGraph& graph, double distance) {
  std::vector<NodeId> junctions;
  std::vector<Vec3> means;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) < 3) continue;
    junctions.push_back(node);
    means.push_back(graph.position(node));
  }
  std::vector<NodeGroup> groups(junctions.size());
  std::vector<int> group_of(junctions.size());
  std::iota(group_of.begin(), group_of.end(), 0);
  std::vector<double> weights;
  for (size_t i = 0; i < junctions.size(); ++i) {
    weights.push_back(graph.Degree(junctions[i]));
    groups[i] = {{junctions[i]}, {weights[i]}};
  }
  std::vector<std::vector<int>> members(junctions.size());
  for (size_t i = 0; i < junctions.size(); ++i) members[i] = {static_cast<int>(i)};
  for (const auto& [apart, i, j] : NearPairs(means, distance)) {
    const int a = std::min(group_of[i], group_of[j]);
    const int b = std::max(group_of[i], group_of[j]);
    if (a == b || (means[a] - means[b]).norm() > distance) continue;
    means[a] = (weights[a] * means[a] + weights[b] * means[b]) / (weights[a] + weights[b]);
    weights[a] += weights[b];
    for (const int member : members[b]) {
      group_of[member] = a;
      members[a].push_back(member);
      groups[a].nodes.push_back(junctions[member]);
      groups[a].weights.push_back(graph.Degree(junctions[member]));
    }
    members[b].clear();
    groups[b] = {};
  }
  std::erase_if(groups, [](const NodeGroup& group) { return group.nodes.size() < 2; });
  MergeNodeGroups(graph, groups, 2 * distance);
}

std::vector<std::pair<EdgeId, EdgeId>> ParallelEdges(const SkeletonGraph& graph, double distance) {
  std::vector<std::pair<EdgeId, EdgeId>> parallel;
  for (const auto& [a, b] : EdgesOfSameNodes(graph)) {
    const Polyline& points_a = graph.edge(a).points;
    const Polyline& points_b = graph.edge(b).points;
    if (StaysWithin(points_a, points_b, distance) && StaysWithin(points_b, points_a, distance))
      parallel.emplace_back(a, b);
  }
  return parallel;
}

void MergeParallelEdges(SkeletonGraph& graph, double distance) {
  for (const auto& [a, b] : ParallelEdges(graph, distance)) {
    if (!graph.HasEdge(a) || !graph.HasEdge(b)) continue;
    SkeletonEdge mean = MeanEdge(graph.edge(a), graph.edge(b));
    graph.RemoveEdge(b);
    graph.SetCurve(a, std::move(mean.points), std::move(mean.radii), std::move(mean.observations));
  }
}

void MergeOverlappingEdges(SkeletonGraph& graph, double distance) {
  for (int round = 0; round < kMaxRounds; ++round) {
    MergeParallelEdges(graph, kParallelSlack * distance);
    graph.DissolveDegree2Nodes();
    std::vector<LocationPair> places;
    for (const Contact& contact : FindContacts(graph, distance)) {
      if (!contact.overlap) continue;
      const std::vector<LocationPair> ends = PlacesToJoin(contact, distance);
      places.insert(places.end(), ends.begin(), ends.end());
    }
    if (places.empty()) return;
    JoinLocations(graph, places, distance);
  }
  MergeParallelEdges(graph, kParallelSlack * distance);
}

void RemoveShortEdges(SkeletonGraph& graph, double length) {
  graph.DissolveDegree2Nodes();
  for (std::vector<EdgeId> edges = ShortEdges(graph, length); !edges.empty();
       edges = ShortEdges(graph, length)) {
    std::vector<EdgeId> links;
    for (const EdgeId id : edges) {
      const SkeletonEdge& edge = graph.edge(id);
      if (edge.nodes[0] == edge.nodes[1] || IsDangling(graph, edge)) {
        graph.RemoveEdge(id);
      } else {
        links.push_back(id);
      }
    }
    ContractLinks(graph, links, length);
    graph.RemoveIsolatedNodes();
    graph.DissolveDegree2Nodes();
  }
}

void PruneSpurs(SkeletonGraph& graph, double length) {
  graph.DissolveDegree2Nodes();
  const auto is_spur = [&graph](EdgeId id) {
    const std::array<NodeId, 2>& nodes = graph.edge(id).nodes;
    return IsDangling(graph, graph.edge(id)) &&
           std::max(graph.Degree(nodes[0]), graph.Degree(nodes[1])) >= 3;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (const EdgeId id : ShortEdges(graph, length)) {
      if (!is_spur(id)) continue;
      graph.RemoveEdge(id);
      changed = true;
    }
    graph.RemoveIsolatedNodes();
    graph.DissolveDegree2Nodes();
  }
}

void RemoveSmallLoops(SkeletonGraph& graph, double length) {
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.nodes[0] == edge.nodes[1] && Length(edge.points) <= length) graph.RemoveEdge(id);
  }
  graph.RemoveIsolatedNodes();
}

}  // namespace curvefusion
