#include "fusion/silhouette_topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "fusion/silhouette_path.h"
#include "graph/hermite_bridge.h"
#include "graph/open_ends.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kMinRefuted = 0.002;    // metres; shorter runs are corners of curves
constexpr double kLongRun = 0.008;       // metres
constexpr double kClearlyFalse = 0.5;    // share of images
constexpr double kMinPiece = 0.012;      // metres; the shortest spur
constexpr double kFitLength = 0.015;     // metres
constexpr double kFacingCosine = 0.6;
constexpr double kStep = 0.002;          // metres
constexpr double kEndReach = 0.008;      // metres; so near to its ends a bridge lies beside curves
constexpr double kCorridor = 0.006;      // metres
constexpr size_t kRetreat = 2;           // points
constexpr double kMaxDetour = 1.3;
constexpr double kSnapDistance = 0.006;  // metres
constexpr double kNear = 0.012;  // metres; so near, a displaced end looks past its curve
constexpr double kClearance = 0.004;     // metres
constexpr double kTrustedShare = 0.9;

std::vector<double> SharesAlong(const WireSilhouettes& silhouettes, const Polyline& points) {
  std::vector<double> shares(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), 16,
              [&](int64_t i) { shares[i] = silhouettes.Share(points[i]); });
  return shares;
}

// A run of points of an edge, both included.
struct Run {
  size_t first;
  size_t last;
};

double LengthOf(const Polyline& points, const Run& run) {
  double length = 0;
  for (size_t i = run.first; i < run.last; ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

// Whether a run of points that few images show as wire is no wire. At its junctions an edge may
// just miss where they should be, and anywhere its wire by little.
bool IsFalse(const SkeletonGraph& skeleton, const SkeletonEdge& edge,
             const std::vector<double>& shares, const Run& run) {
  const double length = LengthOf(edge.points, run);
  if (length >= kLongRun) return true;
  const bool is_at_junction =
      (run.first == 0 && skeleton.Degree(edge.nodes[0]) > 1) ||
      (run.last + 1 == edge.points.size() && skeleton.Degree(edge.nodes[1]) > 1);
  const double least = *std::min_element(shares.begin() + static_cast<std::ptrdiff_t>(run.first),
                                         shares.begin() + static_cast<std::ptrdiff_t>(run.last) + 1);
  return length >= kMinRefuted && !is_at_junction && least < kClearlyFalse;
}

// The longest runs of points that fewer than min_share of the images show as wire.
std::vector<Run> LowRuns(const std::vector<double>& shares, double min_share) {
  std::vector<Run> runs;
  for (size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] >= min_share) continue;
    if (!runs.empty() && runs.back().last + 1 == i) {
      runs.back().last = i;
    } else {
      runs.push_back({i, i});
    }
  }
  return runs;
}

// What is left of all points without the false runs.
std::vector<Run> RunsKept(const SkeletonGraph& skeleton, const SkeletonEdge& edge,
                          const std::vector<double>& shares, double min_share) {
  std::vector<Run> kept;
  size_t first = 0;
  for (const Run& run : LowRuns(shares, min_share)) {
    if (!IsFalse(skeleton, edge, shares, run)) continue;
    if (run.first > first) kept.push_back({first, run.first - 1});
    first = run.last + 1;
  }
  if (first < edge.points.size()) kept.push_back({first, edge.points.size() - 1});
  return kept;
}

template <class T>
std::vector<T> Slice(const std::vector<T>& values, const Run& run) {
  if (values.empty()) return {};
  return {values.begin() + static_cast<std::ptrdiff_t>(run.first),
          values.begin() + static_cast<std::ptrdiff_t>(run.last) + 1};
}

void KeepRuns(EdgeId id, const std::vector<Run>& runs, SkeletonGraph& skeleton) {
  const SkeletonEdge edge = skeleton.TakeEdge(id);
  for (const Run& run : runs) {
    if (LengthOf(edge.points, run) < kMinPiece) continue;
    const bool at_front = run.first == 0;
    const bool at_back = run.last + 1 == edge.points.size();
    skeleton.AddEdge({{at_front ? edge.nodes[0] : skeleton.AddNode(edge.points[run.first]),
                       at_back ? edge.nodes[1] : skeleton.AddNode(edge.points[run.last])},
                      Slice(edge.points, run),
                      Slice(edge.radii, run),
                      Slice(edge.observations, run)});
  }
}

// Ends may lie a wire beside where they should.
bool IsDetour(const Polyline& curve, const Polyline& guide) {
  return Length(curve) > kMaxDetour * Length(guide) + kCorridor;
}

// The points of a curve with low runs replaced by ways through the silhouettes where there are any.
Polyline Rerouted(const WireSilhouettes& silhouettes, const Polyline& points, double min_share) {
  Polyline rerouted;
  size_t next = 0;
  for (const Run& run : LowRuns(SharesAlong(silhouettes, points), min_share)) {
    const size_t from = run.first < kRetreat ? 0 : run.first - kRetreat;
    const size_t to = std::min(run.last + kRetreat, points.size() - 1);
    if (from < next || from == to) continue;
    const Polyline guide(points.begin() + static_cast<std::ptrdiff_t>(from),
                         points.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    const std::optional<Polyline> way =
        PathThroughSilhouettes(silhouettes, guide, kCorridor, min_share);
    if (!way || IsDetour(*way, guide)) continue;
    for (; next < from; ++next) rerouted.push_back(points[next]);
    rerouted.insert(rerouted.end(), way->begin(), way->end() - 1);
    next = to;
  }
  for (; next < points.size(); ++next) rerouted.push_back(points[next]);
  return rerouted;
}

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
                                    const SilhouetteOptions& options, const PointGrid& edges,
                                    const std::vector<OpenEnd>& ends) {
  std::vector<Bridge> bridges;
  for (size_t i = 0; i < ends.size(); ++i) {
    for (size_t j = i + 1; j < ends.size(); ++j) {
      const OpenEnd& a = ends[i];
      const OpenEnd& b = ends[j];
      const Vec3 way = b.position - a.position;
      const double length = way.norm();
      if (a.node == b.node || length > options.max_bridge || length < kStep) continue;
      const double facing = std::min(a.outward.dot(way), -b.outward.dot(way)) / length;
      if (facing < kFacingCosine) continue;
      const Polyline guide =
          Resample(HermiteBridge(a.position, a.outward, b.position, -b.outward), kStep);
      std::optional<Polyline> curve =
          PathThroughSilhouettes(silhouettes, guide, kCorridor, options.min_bridge_share);
      if (!curve || IsDetour(*curve, guide) || !IsClear(*curve, edges)) continue;
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
      const Vec3 way = points[i] - end.position;
      const double length = way.norm();
      if (length > max_gap || length <= 0) continue;
      const double ahead = end.outward.dot(way) / length;
      if (ahead < (length < kNear ? 0 : kFacingCosine)) continue;
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

void VisitOptions(SilhouetteOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"max_frames", "frames", 0, 1000000,
                 "Deviation: images in whose silhouettes curves are looked for; more are thinned "
                 "evenly, 0 = none."},
                options.max_frames);
  visitor.Visit({"min_share", "", 0, 1,
                 "Deviation: parts that a smaller share of the images shows as wire are false."},
                options.min_share);
  visitor.Visit({"max_bridge", "m", 0, 1,
                 "Deviation: how far ends that face each other may be joined through silhouettes."},
                options.max_bridge);
  visitor.Visit({"min_bridge_share", "", 0, 1,
                 "Deviation: the least share of images that must show every place of a bridge."},
                options.min_bridge_share);
}

bool TellWires(const WireSilhouettes& silhouettes, const SkeletonGraph& skeleton) {
  std::vector<double> shares;
  for (const EdgeId id : skeleton.Edges()) {
    const std::vector<double> along = SharesAlong(silhouettes, skeleton.edge(id).points);
    shares.insert(shares.end(), along.begin(), along.end());
  }
  return !shares.empty() && Median(std::move(shares)) >= kTrustedShare;
}

double DropRefutedParts(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                        SkeletonGraph& skeleton) {
  const double before = skeleton.TotalLength();
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    const std::vector<Run> runs =
        RunsKept(skeleton, skeleton.edge(id), SharesAlong(silhouettes, points), options.min_share);
    if (runs.size() == 1 && runs[0].first == 0 && runs[0].last + 1 == points.size()) continue;
    KeepRuns(id, runs, skeleton);
  }
  skeleton.RemoveIsolatedNodes();
  skeleton.DissolveDegree2Nodes();
  return before - skeleton.TotalLength();
}

void RerouteCurves(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                   SkeletonGraph& skeleton) {
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    Polyline points = Rerouted(silhouettes, edge.points, options.min_bridge_share);
    if (points == edge.points) continue;
    const double radius = Median(edge.radii);
    const size_t count = points.size();
    skeleton.SetCurve(id, std::move(points), std::vector<double>(count, radius));
  }
}

int JoinEndsToSides(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                    SkeletonGraph& skeleton) {
  int count = 0;
  for (const NodeId node : skeleton.Nodes()) {
    if (skeleton.Degree(node) != 1) continue;
    const OpenEnd end = FreeEnd(skeleton, node, kFitLength);
    for (const Target& target : TargetsAhead(skeleton, end, options.max_bridge)) {
      const Vec3& p = skeleton.edge(target.edge).points[target.index];
      std::optional<Polyline> curve = PathThroughSilhouettes(
          silhouettes, {end.position, p}, kCorridor, options.min_bridge_share);
      if (!curve || IsDetour(*curve, {end.position, p})) continue;
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

int BridgeOpenEnds(const WireSilhouettes& silhouettes, const SilhouetteOptions& options,
                   SkeletonGraph& skeleton) {
  std::vector<Vec3> positions;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    positions.insert(positions.end(), points.begin(), points.end());
  }
  const std::vector<OpenEnd> ends = OpenEnds(skeleton, kFitLength);
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

}  // namespace curvefusion
