#include "fusion/silhouettes/silhouette_bridges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "fusion/silhouettes/silhouette_path.h"
#include "graph/hermite_bridge.h"
#include "graph/open_ends.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

// Chosen: depth draws curves up to 6 mm beside their wires (docs/lab_notebook.md).
constexpr EndPiece kEndPiece{.length = 0.015};  // metres
constexpr double kFacingCosine = 0.6;
constexpr double kStep = 0.002;       // metres
constexpr double kEndReach = 0.008;   // metres; so near to its ends a bridge lies beside curves
constexpr double kClearance = 0.004;  // metres
constexpr double kNear = 0.012;  // metres; so near, an end beside its place looks past its curve

struct Bridge {
  double cost;
  const OpenEnd* from;
  const OpenEnd* to;
  Polyline curve;
};

// Whether a curve keeps away from all edges but near its ends.
bool IsClear(const Polyline& curve, const PointGrid& edges) {
  const std::vector<double> arc_length = CumulativeLength(curve);
  for (size_t i = 0; i < curve.size(); ++i) {
    if (std::min(arc_length[i], arc_length.back() - arc_length[i]) < kEndReach) continue;
    bool is_clear = true;
    edges.ForEachWithin(curve[i], kClearance, [&](int, const Vec3&) { is_clear = false; });
    if (!is_clear) return false;
  }
  return true;
}

std::vector<Bridge> PossibleBridges(const WireSilhouettes& silhouettes,
                                    const SilhouetteBridgeOptions& options, const PointGrid& edges,
                                    const std::vector<OpenEnd>& ends) {
  std::vector<Bridge> bridges;
  for (size_t i = 0; i < ends.size(); ++i) {
    for (size_t j = i + 1; j < ends.size(); ++j) {
      const OpenEnd& a = ends[i];
      const OpenEnd& b = ends[j];
      const Vec3 offset = b.position - a.position;
      const double length = offset.norm();
      if (a.node == b.node || length > options.max_length || length < kStep) continue;
      const double facing = std::min(a.outward.dot(offset), -b.outward.dot(offset)) / length;
      if (facing < kFacingCosine) continue;
      const Polyline guide =
          Resample(HermiteBridge(a.position, a.outward, b.position, -b.outward), kStep);
      std::optional<Polyline> curve = PathThroughSilhouettes(silhouettes, guide, options.min_share);
      if (!curve || !IsClear(*curve, edges)) continue;
      bridges.push_back({length * (2 - facing), &a, &b, std::move(*curve)});
    }
  }
  std::sort(bridges.begin(), bridges.end(),
            [](const Bridge& a, const Bridge& b) { return a.cost < b.cost; });
  return bridges;
}

// A point of a curve that lies ahead of a free end.
struct Target {
  double cost;
  EdgeId edge;
  size_t index;
};

std::vector<Target> TargetsAhead(const SkeletonGraph& skeleton, const OpenEnd& end,
                                 double max_gap) {
  std::vector<Target> targets;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    const Target none{std::numeric_limits<double>::infinity(), id, 0};
    Target best = none;
    for (size_t i = 0; i < points.size(); ++i) {
      const Vec3 offset = points[i] - end.position;
      const double length = offset.norm();
      if (length > max_gap || length <= 0) continue;
      const double ahead = end.outward.dot(offset) / length;
      if (length > kSnapDistance && ahead < (length < kNear ? 0 : kFacingCosine)) continue;
      const double cost = length * (2 - ahead);
      if (cost < best.cost) best = {cost, id, i};
    }
    if (id != end.edge && std::isfinite(best.cost)) targets.push_back(best);
  }
  std::sort(targets.begin(), targets.end(),
            [](const Target& a, const Target& b) { return a.cost < b.cost; });
  return targets;
}

// The node at a point of an edge, or near it; the edge is split where there is none.
NodeId NodeAt(const Target& target, SkeletonGraph& skeleton) {
  const SkeletonEdge& edge = skeleton.edge(target.edge);
  const Vec3& p = edge.points[target.index];
  if ((p - edge.points.front()).norm() < kSnapDistance) return edge.nodes[0];
  if ((p - edge.points.back()).norm() < kSnapDistance) return edge.nodes[1];
  return skeleton.SplitEdge(target.edge, target.index);
}

double RadiusAt(const SkeletonGraph& skeleton, const OpenEnd& end) {
  const SkeletonEdge& edge = skeleton.edge(end.edge);
  return edge.nodes[0] == end.node ? edge.radii.front() : edge.radii.back();
}

}  // namespace

int BridgeOpenEnds(const WireSilhouettes& silhouettes, const SilhouetteBridgeOptions& options,
                   SkeletonGraph& skeleton) {
  std::vector<Vec3> positions;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    positions.insert(positions.end(), points.begin(), points.end());
  }
  const std::vector<OpenEnd> ends = OpenEnds(skeleton, kEndPiece);
  const std::vector<Bridge> bridges =
      PossibleBridges(silhouettes, options, PointGrid(positions, kClearance), ends);
  std::set<const OpenEnd*> used;
  int count = 0;
  for (const Bridge& bridge : bridges) {
    if (used.count(bridge.from) > 0 || used.count(bridge.to) > 0) continue;
    used.insert({bridge.from, bridge.to});
    const double radius = 0.5 * (RadiusAt(skeleton, *bridge.from) + RadiusAt(skeleton, *bridge.to));
    skeleton.AddEdge({{bridge.from->node, bridge.to->node},
                      bridge.curve,
                      std::vector<double>(bridge.curve.size(), radius),
                      {}});
    ++count;
  }
  skeleton.DissolveDegree2Nodes();
  return count;
}

int JoinEndsToSides(const WireSilhouettes& silhouettes, const SilhouetteBridgeOptions& options,
                    SkeletonGraph& skeleton) {
  int count = 0;
  for (const NodeId node : skeleton.Nodes()) {
    if (skeleton.Degree(node) != 1) continue;
    const OpenEnd end = FreeEnd(skeleton, node, kEndPiece);
    for (const Target& target : TargetsAhead(skeleton, end, options.max_length)) {
      const Vec3& p = skeleton.edge(target.edge).points[target.index];
      std::optional<Polyline> curve =
          PathThroughSilhouettes(silhouettes, {end.position, p}, options.min_share);
      if (!curve) continue;
      const double radius = RadiusAt(skeleton, end);
      const NodeId reached = NodeAt(target, skeleton);
      curve->back() = skeleton.position(reached);
      skeleton.AddEdge({{node, reached}, *curve, std::vector<double>(curve->size(), radius), {}});
      ++count;
      break;
    }
  }
  skeleton.DissolveDegree2Nodes();
  return count;
}

}  // namespace curvefusion
