#include "graph/contraction/noise_edges.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

// Chosen: places at which balls of ball_radius, 4 mm, overlap, and do not reach into those of other
// edges.
constexpr double kStep = 0.003;           // metres, between the places of an edge
constexpr double kNodeClearance = 0.008;  // metres; nearer it lies in the points of other edges
// Chosen on racks of wires some 20 mm apart: noise has less of what was seen of the best places
// nearby, and more of its own points beside it.
constexpr double kMinShare = 0.5;
constexpr double kMaxFlank = 0.4;

struct EdgePlaces {
  std::vector<Vec3> places;
  std::vector<Vec3> directions;
  std::vector<size_t> first = {0};  // of each edge, and the end
};

// At least one place for every edge.
EdgePlaces PlacesAlong(const SkeletonGraph& graph, const std::vector<EdgeId>& edges,
                       double half_chord) {
  EdgePlaces along;
  for (const EdgeId id : edges) {
    const SkeletonEdge& edge = graph.edge(id);
    const std::vector<double> arc_length = CumulativeLength(edge.points);
    const double length = arc_length.back();
    const auto clearance = [&](NodeId node) {
      return graph.Degree(node) >= 3 ? kNodeClearance : 0;
    };
    const double begin = std::min(clearance(edge.nodes[0]), length / 2);
    const double end = std::max(length - clearance(edge.nodes[1]), length / 2);
    for (double at = begin; at <= end; at += kStep) {
      const Vec3 chord = PointAt(edge.points, arc_length, at + half_chord) -
                         PointAt(edge.points, arc_length, at - half_chord);
      along.places.push_back(PointAt(edge.points, arc_length, at));
      along.directions.push_back(chord.norm() > 0 ? Vec3(chord.normalized()) : Vec3::UnitX());
    }
    along.first.push_back(along.places.size());
  }
  return along;
}

// The noise of a graph with its share of what was seen nearby, the weakest first.
std::vector<std::pair<double, EdgeId>> FindNoise(const SkeletonGraph& graph,
                                                 const ObservedPoints& points,
                                                 const PointGrid& grid,
                                                 const RidgeContrastOptions& options) {
  const std::vector<EdgeId> edges = graph.Edges();
  const EdgePlaces along = PlacesAlong(graph, edges, options.ball_radius);
  const RidgeContrast contrast(points, grid, along.places, along.directions, options);
  std::vector<std::pair<double, EdgeId>> noise;
  for (size_t e = 0; e < edges.size(); ++e) {
    double own = 0, best = 0, flank = 0;
    for (size_t i = along.first[e]; i < along.first[e + 1]; ++i) {
      own += contrast.Own(i);
      best += contrast.Best(i);
    }
    if (own >= kMinShare * best) continue;
    for (size_t i = along.first[e]; i < along.first[e + 1]; ++i)
      flank += contrast.Flank(i, RidgeSides::kAround);
    if (flank > kMaxFlank * own) noise.emplace_back(own / best, edges[e]);
  }
  std::sort(noise.begin(), noise.end());
  return noise;
}

// Removes edges in their order, but of those that share a node only the first.
void RemoveOneAtANode(SkeletonGraph& graph, const std::vector<std::pair<double, EdgeId>>& edges) {
  std::set<NodeId> touched;
  for (const auto& [share, id] : edges) {
    const auto [a, b] = graph.edge(id).nodes;
    if (touched.count(a) + touched.count(b) > 0) continue;
    touched.insert({a, b});
    graph.RemoveEdge(id);
  }
  graph.RemoveIsolatedNodes();
  graph.DissolveDegree2Nodes();
}

}  // namespace

void DropNoiseEdges(SkeletonGraph& graph, const ObservedPoints& points,
                    const RidgeContrastOptions& options) {
  if (points.empty()) return;
  const PointGrid grid(points.positions, options.ball_radius);
  for (auto noise = FindNoise(graph, points, grid, options); !noise.empty();
       noise = FindNoise(graph, points, grid, options)) {
    RemoveOneAtANode(graph, noise);
  }
}

}  // namespace curvefusion
