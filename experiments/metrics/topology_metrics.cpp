#include "experiments/metrics/topology_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "experiments/metrics/curve_metrics.h"
#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {
namespace {

constexpr double kControlSpacing = 50 * kMillimetre;  // on a curve, at most
constexpr double kSnapDistance = 10 * kMillimetre;    // how far the other graph may be from one
constexpr double kMaxControlPoints = 4000;            // those of 200 m at 50 mm; takes some 3 s
constexpr double kNoPath = std::numeric_limits<double>::infinity();

// A place on a curve.
struct Place {
  EdgeId edge = 0;
  double arc_length = 0;
};

// The lengths of paths between places on the curves of a graph. Its vertices are the places, by
// their index, and after them the nodes.
class PathLengths {
 public:
  PathLengths(const SkeletonGraph& graph, const std::vector<Place>& places) : places_(places) {
    std::vector<std::vector<int>> places_of_edge;
    for (size_t i = 0; i < places.size(); ++i) {
      places_of_edge.resize(std::max<size_t>(places_of_edge.size(), places[i].edge + 1));
      places_of_edge[places[i].edge].push_back(static_cast<int>(i));
    }
    const std::vector<NodeId> nodes = graph.Nodes();
    neighbours_.resize(places.size() + (nodes.empty() ? 0 : nodes.back() + 1));
    for (const EdgeId edge : graph.Edges()) {
      const bool has_places = static_cast<size_t>(edge) < places_of_edge.size();
      ChainPlaces(graph.edge(edge), has_places ? places_of_edge[edge] : std::vector<int>());
    }
  }

  // From a place to all places, by Dijkstra's method.
  std::vector<double> LengthsFrom(int start) const {
    std::vector<double> lengths(neighbours_.size(), kNoPath);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    queue.emplace(lengths[start] = 0, start);
    while (!queue.empty()) {
      const auto [length, vertex] = queue.top();
      queue.pop();
      if (length > lengths[vertex]) continue;
      for (const auto& [neighbour, step] : neighbours_[vertex]) {
        if (length + step >= lengths[neighbour]) continue;
        queue.emplace(lengths[neighbour] = length + step, neighbour);
      }
    }
    lengths.resize(places_.size());
    return lengths;
  }

 private:
  void Link(int a, int b, double length) {
    neighbours_[a].emplace_back(b, length);
    neighbours_[b].emplace_back(a, length);
  }

  // Links an edge's first node, the places on it in order, and its last node.
  void ChainPlaces(const SkeletonEdge& edge, std::vector<int> on_edge) {
    std::sort(on_edge.begin(), on_edge.end(),
              [&](int a, int b) { return places_[a].arc_length < places_[b].arc_length; });
    const int first_node = static_cast<int>(places_.size());
    int last = first_node + edge.nodes[0];
    double at = 0;
    for (const int place : on_edge) {
      Link(last, place, places_[place].arc_length - at);
      last = place;
      at = places_[place].arc_length;
    }
    Link(last, first_node + edge.nodes[1], std::max(0.0, Length(edge.points) - at));
  }

  const std::vector<Place>& places_;
  std::vector<std::vector<std::pair<int, double>>> neighbours_;
};

// All nodes with edges, each once, and places kControlSpacing apart between them
// at most; farther on long curves, as the time grows with the square of their number.
std::vector<Place> ControlPlaces(const SkeletonGraph& graph) {
  const double spacing = std::max(kControlSpacing, graph.TotalLength() / kMaxControlPoints);
  std::vector<Place> places;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) == 0) continue;
    const EdgeId edge = graph.IncidentEdges(node).front();
    const bool is_start = graph.edge(edge).nodes[0] == node;
    places.push_back({edge, is_start ? 0 : Length(graph.edge(edge).points)});
  }
  for (const EdgeId edge : graph.Edges()) {
    const double length = Length(graph.edge(edge).points);
    const int parts = static_cast<int>(std::ceil(length / spacing));
    for (int k = 1; k < parts; ++k) places.push_back({edge, length * k / parts});
  }
  return places;
}

// The nearest places on the other graph; `is_near` tells whether there is one within reach.
struct SnappedPlaces {
  std::vector<Place> places;
  std::vector<bool> is_near;
};

SnappedPlaces Snap(const SkeletonGraph& from, const std::vector<Place>& places,
                   const SkeletonGraph& to) {
  const SkeletonSamples samples = SampleSkeleton(to);
  const PointIndex index(samples.positions);
  SnappedPlaces snapped;
  for (const Place& place : places) {
    const Polyline& points = from.edge(place.edge).points;
    const Vec3 p = PointAt(points, CumulativeLength(points), place.arc_length);
    const EdgeId nearest = samples.edges[index.Nearest(p)];
    const PolylineProjection projection = Project(to.edge(nearest).points, p);
    snapped.places.push_back({nearest, projection.arc_length});
    snapped.is_near.push_back(projection.distance <= kSnapDistance);
  }
  return snapped;
}

struct PathCost {
  double sum = 0;
  int64_t pairs = 0;
};

// The cost of all pairs (start, j) with j > start.
PathCost CostFrom(int start, const PathLengths& from_paths, const PathLengths& to_paths,
                  const std::vector<bool>& is_near) {
  const std::vector<double> wanted = from_paths.LengthsFrom(start);
  const std::vector<double> existing = to_paths.LengthsFrom(start);
  PathCost cost;
  for (size_t j = start + 1; j < wanted.size(); ++j) {
    if (wanted[j] == kNoPath || wanted[j] <= 0) continue;
    ++cost.pairs;
    const bool exists = is_near[start] && is_near[j] && existing[j] != kNoPath;
    cost.sum += exists ? std::min(1.0, std::abs(wanted[j] - existing[j]) / wanted[j]) : 1;
  }
  return cost;
}

}  // namespace

TopologyScores CompareTopology(const SkeletonGraph& result, const SkeletonGraph& truth) {
  return {result.ComponentCount(), truth.ComponentCount(), result.CycleRank(), truth.CycleRank()};
}

std::optional<double> PathSimilarity(const SkeletonGraph& from, const SkeletonGraph& to) {
  if (from.empty()) return std::nullopt;
  if (to.empty()) return 0;
  const std::vector<Place> places = ControlPlaces(from);
  const SnappedPlaces snapped = Snap(from, places, to);
  const PathLengths from_paths(from, places);
  const PathLengths to_paths(to, snapped.places);
  std::vector<PathCost> costs(places.size());
  ParallelFor(0, static_cast<int64_t>(places.size()), 1, [&](int64_t i) {
    costs[i] = CostFrom(static_cast<int>(i), from_paths, to_paths, snapped.is_near);
  });
  PathCost total;
  for (const PathCost& cost : costs) {
    total.sum += cost.sum;
    total.pairs += cost.pairs;
  }
  if (total.pairs == 0) return std::nullopt;
  return 1 - total.sum / static_cast<double>(total.pairs);
}

std::optional<double> AplsScores::Apls() const {
  return PrecisionRecall{result_to_truth, truth_to_result}.F();
}

AplsScores ComparePaths(const SkeletonGraph& result, const SkeletonGraph& truth) {
  return {PathSimilarity(truth, result), PathSimilarity(result, truth)};
}

}  // namespace curvefusion
