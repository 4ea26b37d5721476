#include "fusion/silhouettes/silhouette_pruning.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/silhouettes/silhouette_path.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr size_t kRetreat = 2;  // points; near a place beside the wire others may be too

// The points of a curve with low runs replaced by paths through the silhouettes where there are
// any.
Polyline Rerouted(const WireSilhouettes& silhouettes, const Polyline& points, double min_share) {
  Polyline rerouted;
  size_t next = 0;
  for (const EdgePart& run : LowRuns(silhouettes.SharesAlong(points), min_share)) {
    const size_t from = run.first < kRetreat ? 0 : run.first - kRetreat;
    const size_t to = std::min(run.last + kRetreat, points.size() - 1);
    if (from < next || from == to) continue;
    const Polyline guide(points.begin() + static_cast<std::ptrdiff_t>(from),
                         points.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    const std::optional<Polyline> detour = PathThroughSilhouettes(silhouettes, guide, min_share);
    if (!detour) continue;
    for (; next < from; ++next) rerouted.push_back(points[next]);
    rerouted.insert(rerouted.end(), detour->begin(), detour->end() - 1);
    next = to;
  }
  for (; next < points.size(); ++next) rerouted.push_back(points[next]);
  return rerouted;
}

}  // namespace

void MoveJunctionsIntoWires(const WireSilhouettes& silhouettes, double min_share,
                            SkeletonGraph& skeleton) {
  for (const NodeId node : skeleton.Nodes()) {
    const Vec3 p = skeleton.position(node);
    if (skeleton.Degree(node) < 2 || silhouettes.Share(p) >= min_share) continue;
    const std::optional<Vec3> place = NearestWire(silhouettes, p, min_share);
    if (place) skeleton.MoveNode(node, *place);
  }
}

void RerouteCurves(const WireSilhouettes& silhouettes, double min_share, SkeletonGraph& skeleton) {
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    Polyline points = Rerouted(silhouettes, edge.points, min_share);
    if (points == edge.points) continue;
    const double radius = Median(edge.radii);
    const size_t count = points.size();
    skeleton.SetCurve(id, std::move(points), std::vector<double>(count, radius));
  }
}

}  // namespace curvefusion
