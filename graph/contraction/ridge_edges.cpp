#include "graph/contraction/ridge_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "graph/contraction/ridge_contrast.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr double kStep = 0.003;
constexpr int kDirectionsAcross = 6;
constexpr double kNoNoise = -1;  // in place of the share of an edge

// A place on an edge with its direction and one across, which turns no more than it must.
struct EdgePlace {
  Vec3 position;
  Vec3 direction;
  Vec3 across;
  double count = 0;
};

// At least one place for every edge.
std::vector<EdgePlace> PlacesAlong(const SkeletonGraph& graph, EdgeId id,
                                   const RidgeEdgeOptions& options) {
  const SkeletonEdge& edge = graph.edge(id);
  const std::vector<double> arc_length = CumulativeLength(edge.points);
  const auto clearance = [&](NodeId node) {
    return graph.Degree(node) >= 3 ? options.node_clearance : 0;
  };
  const double length = arc_length.back();
  const double first = std::min(clearance(edge.nodes[0]), length / 2);
  const double last = std::max(length - clearance(edge.nodes[1]), length / 2);
  std::vector<EdgePlace> places;
  for (double at = first; at <= last; at += kStep) {
    const Vec3 chord = PointAt(edge.points, arc_length, at + options.ball_radius) -
                       PointAt(edge.points, arc_length, at - options.ball_radius);
    const Vec3 direction = chord.norm() > 0 ? Vec3(chord.normalized()) : Vec3(Vec3::UnitX());
    Vec3 across = places.empty() ? direction.unitOrthogonal() : places.back().across;
    across -= direction.dot(across) * direction;
    across = across.norm() > 0 ? Vec3(across.normalized()) : direction.unitOrthogonal();
    places.push_back({PointAt(edge.points, arc_length, at), direction, across, 0});
  }
  return places;
}

// Whether an edge and one or two others close a loop of at most so long.
bool ClosesShortLoop(const SkeletonGraph& graph, EdgeId id, double limit) {
  const auto [a, b] = graph.edge(id).nodes;
  const double own = Length(graph.edge(id).points);
  for (const EdgeId first : graph.IncidentEdges(a)) {
    const NodeId corner = graph.OtherEnd(first, a);
    const double around = own + Length(graph.edge(first).points);
    if (first == id || corner == a || around > limit) continue;
    if (corner == b) return true;
    for (const EdgeId second : graph.IncidentEdges(b)) {
      if (second == id || graph.OtherEnd(second, b) != corner) continue;
      if (around + Length(graph.edge(second).points) <= limit) return true;
    }
  }
  return false;
}

// How much was seen along the edges of a graph and beside them.
class EdgeContrast {
 public:
  EdgeContrast(const ObservedPoints& points, const RidgeEdgeOptions& options)
      : options_(options), counts_(points.counts), grid_(points.positions, options.ball_radius) {}

  // The noise of a graph with its share of what was seen nearby, the weakest first.
  std::vector<std::pair<double, EdgeId>> Noise(const SkeletonGraph& graph) const {
    const std::vector<EdgeId> edges = graph.Edges();
    const auto n = static_cast<int64_t>(edges.size());
    std::vector<std::vector<EdgePlace>> places_of_edge(edges.size());
    ParallelFor(0, n, 1, [&](int64_t e) {
      places_of_edge[e] = PlacesAlong(graph, edges[e], options_);
      for (EdgePlace& place : places_of_edge[e]) place.count = CountAt(place.position);
    });
    std::vector<Vec3> positions;
    std::vector<double> counts;
    for (const std::vector<EdgePlace>& places : places_of_edge) {
      for (const EdgePlace& place : places) {
        positions.push_back(place.position);
        counts.push_back(place.count);
      }
    }
    const PointGrid all(positions, options_.neighbourhood);
    std::vector<double> share_of_noise(edges.size(), kNoNoise);
    ParallelFor(0, n, 1, [&](int64_t e) {
      const double share = Share(places_of_edge[e], all, counts);
      if (share >= options_.min_share) return;
      const bool is_in_fork =
          share < options_.min_loop_share && ClosesShortLoop(graph, edges[e], options_.short_loop);
      if (is_in_fork || Flank(places_of_edge[e]) > options_.max_flank) share_of_noise[e] = share;
    });
    std::vector<std::pair<double, EdgeId>> noise;
    for (size_t e = 0; e < edges.size(); ++e) {
      if (share_of_noise[e] != kNoNoise) noise.emplace_back(share_of_noise[e], edges[e]);
    }
    std::sort(noise.begin(), noise.end());
    return noise;
  }

 private:
  // What was seen along an edge over what was seen at the best places within the neighbourhood.
  double Share(const std::vector<EdgePlace>& places, const PointGrid& all,
               const std::vector<double>& counts) const {
    double own = 0;
    double best = 0;
    for (const EdgePlace& place : places) {
      double best_here = 0;
      all.ForEachWithin(place.position, options_.neighbourhood,
                        [&](int i, const Vec3&) { best_here = std::max(best_here, counts[i]); });
      own += place.count;
      best += best_here;
    }
    return best > 0 ? own / best : 0;
  }

  // What was seen on the emptier of two opposite sides over what was seen along the edge, for the
  // two sides for which that is most.
  double Flank(const std::vector<EdgePlace>& places) const {
    double own = 0;
    for (const EdgePlace& place : places) own += place.count;
    double fullest = 0;
    for (int k = 0; k < kDirectionsAcross; ++k) {
      const double angle = std::numbers::pi * k / kDirectionsAcross;
      std::array<double, 2> sides{0, 0};
      for (const EdgePlace& place : places) {
        const Vec3 side =
            options_.flank_distance * (std::cos(angle) * place.across +
                                       std::sin(angle) * place.direction.cross(place.across));
        sides[0] += CountAt(place.position + side);
        sides[1] += CountAt(place.position - side);
      }
      fullest = std::max(fullest, std::min(sides[0], sides[1]));
    }
    return own > 0 ? fullest / own : 0;
  }

  double CountAt(const Vec3& p) const {
    return CountWithin(grid_, counts_, p, options_.ball_radius);
  }

  const RidgeEdgeOptions& options_;
  const std::vector<float>& counts_;
  PointGrid grid_;
};

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

void VisitOptions(RidgeEdgeOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"ball_radius", "m", 0.0005, 0.05,
                 "Deviation: what was seen of a place are the points within this distance."},
                options.ball_radius);
  visitor.Visit({"flank_distance", "m", 0.001, 0.05,
                 "Deviation: how far beside an edge noise is looked for."},
                options.flank_distance);
  visitor.Visit({"node_clearance", "m", 0, 0.1,
                 "Deviation: so near to a junction an edge lies in the points of others."},
                options.node_clearance);
  visitor.Visit({"neighbourhood", "m", 0.001, 0.2,
                 "Deviation: an edge is compared with the best places within this distance."},
                options.neighbourhood);
  visitor.Visit({"min_share", "", 0, 1,
                 "Deviation: an edge is weak with less than this part of what was seen of the best "
                 "places nearby; 0 = none is."},
                options.min_share);
  visitor.Visit({"max_flank", "", 0, 100,
                 "Deviation: a weak edge beside which, on two opposite sides, more than this part "
                 "of its own points was seen is noise."},
                options.max_flank);
  visitor.Visit({"short_loop", "m", 0, 1,
                 "Deviation: where wires part at a small angle noise closes triangles of up to "
                 "this length."},
                options.short_loop);
  visitor.Visit({"min_loop_share", "", 0, 1,
                 "Deviation: an edge of such a triangle is noise with less than this part of what "
                 "was seen of the best places nearby."},
                options.min_loop_share);
}

void DropNoiseEdges(SkeletonGraph& graph, const ObservedPoints& points,
                    const RidgeEdgeOptions& options) {
  if (points.empty()) return;
  const EdgeContrast contrast(points, options);
  for (auto noise = contrast.Noise(graph); !noise.empty(); noise = contrast.Noise(graph)) {
    RemoveOneAtANode(graph, noise);
  }
}

}  // namespace curvefusion
