#include "fusion/live/live_snapshot.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "fusion/best/contraction_space.h"
#include "graph/contraction/ridge_projection.h"
#include "graph/intersections.h"
#include "graph/validate.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: a second in view, as the README asks for, at 30 frames a second of which every second is
// looked at.
constexpr double kEnoughFrames = 15;
constexpr double kEnoughSpread = std::numbers::pi / 3;  // chosen: what is behind shows beside it

CurveSightings SightingsOn(const SkeletonEdge& edge, const SightingGrid& grid) {
  const Polyline places = Resample(edge.points, SightingGrid::kCell);
  const std::vector<Vec3> tangents = Tangents(places);
  std::vector<double> frames, spreads;
  CurveSightings seen;
  const size_t middle = places.size() / 2;
  for (size_t i = 0; i < places.size(); ++i) {
    const Sightings sightings = grid.Around(places[i]);
    frames.push_back(sightings.frames);
    if (tangents[i].isZero()) continue;
    const ViewArc arc = ArcAround(sightings.views, tangents[i]);
    spreads.push_back(arc.spread);
    if (i == middle) seen.look_from = arc.least_seen;
  }
  seen.at = places[middle];
  seen.frames = static_cast<int>(Quantile(std::move(frames), 0.5));
  if (!spreads.empty()) seen.spread = Quantile(std::move(spreads), 0.5);
  seen.evidence = EvidenceOf(seen.frames, seen.spread);
  if (seen.spread >= kEnoughSpread) seen.look_from.setZero();
  return seen;
}

}  // namespace

double EvidenceOf(int frames, double spread) {
  return std::min({1.0, frames / kEnoughFrames, spread / kEnoughSpread});
}

LiveSnapshot MakeSnapshot(const LiveEvidence& evidence, const BestOptions& options) {
  const ObservedPoints& points = evidence.carried.points();
  const ContractionSpace space = {1, evidence.ray_noise_ratio};
  std::optional<RidgePoints> ridge;
  if (space.IsWorld()) {
    ridge = FollowRidges(points, evidence.carried.ridges(), options.ridge.projection);
  }
  LiveSnapshot snapshot;
  snapshot.graph = ContractIn(space, points, ridge, options.ridge);
  ResolveIntersections(snapshot.graph, kProximity);
  const SkeletonGraph& graph = snapshot.graph;
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    CurveSightings seen = SightingsOn(edge, evidence.sightings);
    for (int end = 0; end < 2; ++end) seen.free_ends[end] = graph.Degree(edge.nodes[end]) == 1;
    snapshot.curves.push_back(seen);
  }
  return snapshot;
}

}  // namespace curvefusion
