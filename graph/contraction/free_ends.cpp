#include "graph/contraction/free_ends.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "graph/contraction/gap_evidence.h"
#include "graph/hermite_bridge.h"
#include "graph/open_ends.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

// Chosen: a piece that hangs at a junction is less likely to be noise than one on its own.
constexpr double kAttachedFactor = 2;
// Chosen: where two ends continue each other this well, within 26 degrees, the longer of their
// edges vouches for both.
constexpr double kContinuing = 0.9;
// All chosen.
constexpr double kMaxAngle = 1.1;        // radians, at which an end reaches nothing any more
constexpr double kMaxFacingAngle = 1.2;  // radians, at which two ends do not face each other
constexpr double kFitLength = 0.015;     // metres: length of the end piece that gives its direction
constexpr double kMinLoop = 0.035;       // metres: bridges close no shorter loops

struct FacingEnd : OpenEnd {
  double max_gap;  ///< farther it reaches in no direction
};

// A point on a curve that an end may be joined to.
struct CurvePoint {
  EdgeId edge;
  int index;
};

struct Join {
  double cost;
  int end;
  EdgeId edge;
  int index;
  const FacingEnd* facing;  ///< what it continues; null for the side of a curve
  bool operator<(const Join& other) const {
    return std::tie(cost, end, edge, index) <
           std::tie(other.cost, other.end, other.edge, other.index);
  }
};

// The points of an edge at a node, from the node on.
Polyline PointsFrom(const SkeletonGraph& graph, NodeId node, EdgeId id) {
  const SkeletonEdge& edge = graph.edge(id);
  Polyline points = edge.points;
  if (edge.nodes[0] != node) std::reverse(points.begin(), points.end());
  return points;
}

FacingEnd WithReach(const SkeletonGraph& graph, const OpenEnd& end, const FreeEndOptions& options) {
  const double factor = graph.Degree(graph.OtherEnd(end.edge, end.node)) >= 3 ? kAttachedFactor : 1;
  const double length = Length(graph.edge(end.edge).points);
  return {end, std::max(options.touch_distance, factor * options.max_gap_per_length * length)};
}

std::vector<FacingEnd> FreeEnds(const SkeletonGraph& graph, const FreeEndOptions& options) {
  std::vector<FacingEnd> ends;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) != 1) continue;
    ends.push_back(WithReach(graph, FreeEnd(graph, node, {.length = kFitLength}), options));
  }
  return ends;
}

// By node, what an end may continue there: the free end, or the branches of a junction that nothing
// leaves on the other side.
using FacingEnds = std::vector<std::vector<FacingEnd>>;

FacingEnds FindFacingEnds(const SkeletonGraph& graph, const FreeEndOptions& options) {
  FacingEnds facing;
  if (!graph.Nodes().empty()) facing.resize(graph.Nodes().back() + 1);
  for (const OpenEnd& end : OpenEnds(graph, {.length = kFitLength}))
    facing[end.node].push_back(WithReach(graph, end, options));
  return facing;
}

// Length of the loop that joining an end to a point of a neighbouring edge would close; infinite
// where the two edges share no node.
double LoopLength(const SkeletonGraph& graph, const FacingEnd& end, const CurvePoint& target) {
  const SkeletonEdge& from = graph.edge(end.edge);
  const SkeletonEdge& to = graph.edge(target.edge);
  const std::vector<double> arc_length = CumulativeLength(to.points);
  const double position = arc_length[target.index];
  if (end.edge == target.edge) {
    return from.nodes[0] == end.node ? position : arc_length.back() - position;
  }
  const NodeId root = graph.OtherEnd(end.edge, end.node);
  double length = std::numeric_limits<double>::infinity();
  if (to.nodes[0] == root) length = position;
  if (to.nodes[1] == root) length = std::min(length, arc_length.back() - position);
  return length + Length(from.points);
}

// The end of the target edge that lies near the target point, or -1.
NodeId NodeNear(const SkeletonGraph& graph, const CurvePoint& target, double distance) {
  const SkeletonEdge& edge = graph.edge(target.edge);
  const Vec3& p = edge.points[target.index];
  const double first = (p - edge.points.front()).norm();
  const double last = (p - edge.points.back()).norm();
  if (std::min(first, last) > distance) return -1;
  return first <= last ? edge.nodes[0] : edge.nodes[1];
}

// Whether a point of a curve lies just behind a free end of it that looks the other way than `end`:
// then the two ends belong together, and the end must not run into the side of the other's tip.
bool IsBehindFacingEnd(const SkeletonGraph& graph, const FacingEnd& end, const CurvePoint& target,
                       const FacingEnds& facing, const FreeEndOptions& options) {
  const SkeletonEdge& edge = graph.edge(target.edge);
  return std::any_of(edge.nodes.begin(), edge.nodes.end(), [&](NodeId node) {
    if (node == end.node || graph.Degree(node) != 1) return false;
    const FacingEnd& other = facing[node].front();
    return other.outward.dot(end.outward) < 0 &&
           (other.position - edge.points[target.index]).norm() < options.max_gap;
  });
}

// How far an end may reach in a direction that makes an angle of this cosine with its own.
double ReachAt(double cosine, double max_gap, double max_angle, double touch_distance) {
  const double least = std::cos(max_angle);
  const double reach = max_gap * (cosine - least) / (1 - least);
  return cosine > 0 ? std::max(reach, touch_distance) : reach;
}

double ReachForSide(const FacingEnd& end, const Vec3& p, const GapEvidence& evidence,
                    const FreeEndOptions& options) {
  const Vec3 gap = p - end.position;
  double reach = ReachAt(end.outward.dot(gap.normalized()), options.max_gap, kMaxAngle,
                         options.touch_distance);
  if (gap.norm() > reach && gap.norm() < reach * (1 + options.evidence_gain)) {
    reach *= 1 + options.evidence_gain * evidence.PointShare(end.position, p);
  }
  return std::min(reach, end.max_gap);
}

// For a point next to the other end, which may lie ahead where the ends overlap.
double ReachForFacing(const FacingEnd& end, const FacingEnd& other, const Vec3& p,
                      const FreeEndOptions& options) {
  const Vec3 direction = (p - end.position).normalized();
  const double cosine = std::min(end.outward.dot(direction), -other.outward.dot(direction));
  if (!other.is_free && cosine < kContinuing) return 0;
  const double reach =
      ReachAt(cosine, options.max_facing_gap, kMaxFacingAngle, options.touch_distance);
  return std::min(reach, cosine > kContinuing ? std::max(end.max_gap, other.max_gap)
                                              : std::min(end.max_gap, other.max_gap));
}

// What joining an end to a point costs: its length over how far the end may reach there; infinite
// where it is not allowed.
Join MakeJoin(const SkeletonGraph& graph, const std::vector<FacingEnd>& ends, int index,
              const CurvePoint& target, const FacingEnds& facing, const GapEvidence& evidence,
              const FreeEndOptions& options) {
  const FacingEnd& end = ends[index];
  Join join{std::numeric_limits<double>::infinity(), index, target.edge, target.index, nullptr};
  const Vec3& p = graph.edge(target.edge).points[target.index];
  const double length = (p - end.position).norm();
  const NodeId node = NodeNear(graph, target, kSnapDistance);
  if (node == end.node || length <= 0) return join;
  double reach = 0;
  const bool is_free = node >= 0 && graph.Degree(node) == 1;
  if (!is_free && !IsBehindFacingEnd(graph, end, target, facing, options)) {
    reach = ReachForSide(end, p, evidence, options);
  }
  if (node >= 0) {
    for (const FacingEnd& other : facing[node]) {
      const double reach_for_it = ReachForFacing(end, other, p, options);
      if (reach_for_it <= reach || length > reach_for_it) continue;
      if (evidence.IsCrossed(end.position, other.position, {end.edge, other.edge})) continue;
      reach = reach_for_it;
      join.facing = &other;
    }
  }
  if (length <= reach && LoopLength(graph, end, target) >= kMinLoop) {
    join.cost = length / reach;
  }
  return join;
}

std::vector<Join> CandidateJoins(const SkeletonGraph& graph, const std::vector<FacingEnd>& ends,
                                 const FacingEnds& facing, const GapEvidence& evidence,
                                 const FreeEndOptions& options) {
  std::vector<Vec3> positions;
  std::vector<CurvePoint> targets;
  for (const EdgeId id : graph.Edges()) {
    const Polyline& points = graph.edge(id).points;
    for (size_t i = 0; i < points.size(); ++i) {
      positions.push_back(points[i]);
      targets.push_back({id, static_cast<int>(i)});
    }
  }
  const double reach =
      std::max((1 + options.evidence_gain) * options.max_gap, options.max_facing_gap);
  const PointGrid grid(positions, reach);
  std::vector<std::vector<Join>> by_end(ends.size());
  ParallelFor(0, static_cast<int64_t>(ends.size()), 1, [&](int64_t e) {
    grid.ForEachWithin(ends[e].position, reach, [&](int i, const Vec3&) {
      const Join join =
          MakeJoin(graph, ends, static_cast<int>(e), targets[i], facing, evidence, options);
      if (std::isfinite(join.cost)) by_end[e].push_back(join);
    });
  });
  std::vector<Join> joins;
  for (const auto& of_end : by_end) joins.insert(joins.end(), of_end.begin(), of_end.end());
  std::sort(joins.begin(), joins.end());
  return joins;
}

// The cheapest joins such that each end is used once.
std::vector<Join> SelectJoins(const SkeletonGraph& graph, const std::vector<FacingEnd>& ends,
                              const FacingEnds& facing, const GapEvidence& evidence,
                              const FreeEndOptions& options) {
  std::map<NodeId, char> used;
  std::vector<Join> selected;
  for (const Join& join : CandidateJoins(graph, ends, facing, evidence, options)) {
    const NodeId from = ends[join.end].node;
    const NodeId to = NodeNear(graph, {join.edge, join.index}, kSnapDistance);
    if (used[from] || (to >= 0 && used[to])) continue;
    used[from] = 1;
    if (to >= 0 && graph.Degree(to) == 1) used[to] = 1;
    selected.push_back(join);
  }
  return selected;
}

// The curve with its first `tip` replaced by the straight continuation of the next `length`.
Polyline WithStraightTip(const Polyline& points, double tip, double length) {
  const std::vector<double> arc_length = CumulativeLength(points);
  const Vec3 root = PointAt(points, arc_length, tip);
  const Vec3 outward = (root - PointAt(points, arc_length, tip + length)).normalized();
  const double overhang = std::max(0.0, outward.dot(points.front() - root));
  Polyline straight{root + overhang * outward};
  for (size_t i = 1; i < points.size(); ++i) {
    if (arc_length[i] > tip) straight.push_back(points[i]);
  }
  return straight;
}

struct Bridge {
  const FacingEnd* from;
  NodeId to;
  const FacingEnd* facing;
};

// On in the end's direction, and in that of what it continues there.
Polyline BridgeCurve(const SkeletonGraph& graph, const Bridge& bridge) {
  const Vec3& a = bridge.from->position;
  const Vec3& b = graph.position(bridge.to);
  if (bridge.facing == nullptr) return {a, b};
  return HermiteBridge(a, bridge.from->outward, b, -bridge.facing->outward);
}

}  // namespace

void VisitOptions(FreeEndOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"max_gap", "m", 0, 0.1, "Deviation: how far an end may reach for a curve straight ahead."},
      options.max_gap);
  visitor.Visit({"evidence_gain", "", 0, 10,
                 "Deviation: how much farther, over the gap, an end may reach for a curve where "
                 "points lie all the way."},
                options.evidence_gain);
  visitor.Visit({"evidence_radius", "m", 0.0005, 0.05,
                 "Deviation: points this near to the bridge lie in the gap."},
                options.evidence_radius);
  visitor.Visit({"max_facing_gap", "m", 0, 0.1,
                 "Deviation: how far an end may reach for another end that faces it."},
                options.max_facing_gap);
  visitor.Visit({"touch_distance", "m", 0, 0.1,
                 "Deviation: how far an end reaches ahead whatever the angle."},
                options.touch_distance);
  visitor.Visit(
      {"tip_length", "m", 0, 0.1, "Deviation: so much of a free end is noise and straightened."},
      options.tip_length);
}

void StraightenTips(SkeletonGraph& graph, const FreeEndOptions& options) {
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) != 1) continue;
    const EdgeId edge = graph.IncidentEdges(node)[0];
    Polyline points = PointsFrom(graph, node, edge);
    if (Length(points) < options.tip_length + kFitLength) continue;
    points = WithStraightTip(points, options.tip_length, kFitLength);
    graph.MoveNode(node, points.front());
    if (graph.edge(edge).nodes[0] != node) std::reverse(points.begin(), points.end());
    graph.SetCurve(edge, std::move(points));
  }
}

void CloseFreeEnds(SkeletonGraph& graph, const FreeEndOptions& options,
                   const ObservedPoints& points) {
  const std::vector<FacingEnd> ends = FreeEnds(graph, options);
  if (ends.empty()) return;
  const FacingEnds facing = FindFacingEnds(graph, options);
  const std::vector<Join> joins = SelectJoins(
      graph, ends, facing, GapEvidence(graph, points, options.evidence_radius), options);
  std::vector<Bridge> bridges;
  std::map<EdgeId, std::map<int, std::vector<const FacingEnd*>, std::greater<>>> splits;
  for (const Join& join : joins) {
    const NodeId node = NodeNear(graph, {join.edge, join.index}, kSnapDistance);
    const FacingEnd* from = &ends[join.end];
    if (node >= 0) bridges.push_back({from, node, join.facing});
    if (node < 0) splits[join.edge][join.index].push_back(from);
  }
  // From the back of each edge to its front, so that the indices of the front part stay.
  for (const auto& [edge, ends_of_index] : splits) {
    EdgeId front = edge;
    for (const auto& [index, sources] : ends_of_index) {
      const NodeId node = graph.SplitEdge(front, static_cast<size_t>(index));
      front = graph.IncidentEdges(node)[0];
      for (const FacingEnd* source : sources) bridges.push_back({source, node, nullptr});
    }
  }
  for (const Bridge& bridge : bridges) {
    if (bridge.from->position == graph.position(bridge.to)) continue;
    graph.AddEdge({{bridge.from->node, bridge.to}, BridgeCurve(graph, bridge), {}, {}});
  }
  graph.DissolveDegree2Nodes();
}

}  // namespace curvefusion
