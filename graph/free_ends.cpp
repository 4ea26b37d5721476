#include "graph/free_ends.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "graph/point_grid.h"

namespace curvefusion {

namespace {

// A piece that hangs at a junction is less likely to be noise than one on its own.
constexpr double kAttachedFactor = 2;

struct FreeEnd {
  NodeId node;
  EdgeId edge;
  Vec3 position;
  Vec3 outward;
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
  bool operator<(const Join& other) const {
    return std::tie(cost, end, edge, index) <
           std::tie(other.cost, other.end, other.edge, other.index);
  }
};

// The points of the only edge at a node, from the node on.
Polyline PointsFrom(const SkeletonGraph& graph, NodeId node) {
  const SkeletonEdge& edge = graph.edge(graph.IncidentEdges(node)[0]);
  Polyline points = edge.points;
  if (edge.nodes[0] != node) std::reverse(points.begin(), points.end());
  return points;
}

FreeEnd MakeFreeEnd(const SkeletonGraph& graph, NodeId node, const FreeEndOptions& options) {
  const Polyline points = PointsFrom(graph, node);
  const std::vector<double> arc_length = CumulativeLength(points);
  const Vec3 inner = PointAt(points, arc_length, options.fit_length);
  const EdgeId id = graph.IncidentEdges(node)[0];
  const double factor = graph.Degree(graph.OtherEnd(id, node)) >= 3 ? kAttachedFactor : 1;
  return {
      node, id, points.front(), (points.front() - inner).normalized(),
      std::max(options.touch_distance, factor * options.max_gap_per_length * arc_length.back())};
}

std::vector<FreeEnd> FreeEnds(const SkeletonGraph& graph, const FreeEndOptions& options) {
  std::vector<FreeEnd> ends;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) == 1) ends.push_back(MakeFreeEnd(graph, node, options));
  }
  return ends;
}

// Length of the loop that joining an end to a point of a neighbouring edge would close; infinite
// where the two edges share no node.
double LoopLength(const SkeletonGraph& graph, const FreeEnd& end, const CurvePoint& target) {
  const SkeletonEdge& from = graph.edge(end.edge);
  const SkeletonEdge& to = graph.edge(target.edge);
  const std::vector<double> arc_length = CumulativeLength(to.points);
  const double position = arc_length[target.index];
  if (end.edge == target.edge) {
    return from.nodes[0] == end.node ? position : arc_length.back() - position;
  }
  const NodeId root = graph.OtherEnd(end.edge, end.node);
  double way = std::numeric_limits<double>::infinity();
  if (to.nodes[0] == root) way = position;
  if (to.nodes[1] == root) way = std::min(way, arc_length.back() - position);
  return way + Length(from.points);
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

// Whether points were seen where no curve is.
class GapEvidence {
 public:
  GapEvidence(const ObservedPoints& points, const FreeEndOptions& options)
      : grid_(points.positions, options.evidence_radius),
        is_empty_(points.empty()),
        radius_(options.evidence_radius) {}

  // The share of the way from a to b, but for what the ends themselves account for, along which
  // points lie.
  double Share(const Vec3& a, const Vec3& b) const {
    const double length = (b - a).norm();
    const int steps = static_cast<int>((length - 2 * radius_) / kStep);
    if (is_empty_ || steps < 1) return 0;
    int seen = 0;
    for (int i = 0; i < steps; ++i) {
      const Vec3 p = a + (radius_ + i * kStep) / length * (b - a);
      bool has_points = false;
      grid_.ForEachWithin(p, radius_, [&](int, const Vec3&) { has_points = true; });
      seen += has_points ? 1 : 0;
    }
    return static_cast<double>(seen) / steps;
  }

 private:
  static constexpr double kStep = 0.001;
  PointGrid grid_;
  bool is_empty_;
  double radius_;
};

// Whether a point of a curve lies just behind a free end of it that looks the other way than `end`:
// then the two ends belong together, and the end must not run into the side of the other's tip.
bool IsBehindFacingEnd(const SkeletonGraph& graph, const FreeEnd& end, const CurvePoint& target,
                       const std::vector<const FreeEnd*>& end_of_node,
                       const FreeEndOptions& options) {
  const SkeletonEdge& edge = graph.edge(target.edge);
  return std::any_of(edge.nodes.begin(), edge.nodes.end(), [&](NodeId node) {
    const FreeEnd* other = end_of_node[node];
    return other != nullptr && node != end.node && other->outward.dot(end.outward) < 0 &&
           (other->position - edge.points[target.index]).norm() < options.max_gap;
  });
}

// What a join costs: its length over how far the end may reach in that direction; infinite where it
// is not allowed.
double JoinCost(const SkeletonGraph& graph, const FreeEnd& end, const CurvePoint& target,
                const std::vector<const FreeEnd*>& end_of_node, const GapEvidence& evidence,
                const FreeEndOptions& options) {
  constexpr double kForbidden = std::numeric_limits<double>::infinity();
  const Vec3 gap = graph.edge(target.edge).points[target.index] - end.position;
  const double length = gap.norm();
  const NodeId node = NodeNear(graph, target, options.snap_distance);
  if (node == end.node || length <= 0) return kForbidden;
  const FreeEnd* other = node >= 0 ? end_of_node[node] : nullptr;
  if (other == nullptr && IsBehindFacingEnd(graph, end, target, end_of_node, options)) {
    return kForbidden;
  }
  double cosine = end.outward.dot(gap) / length;
  if (other != nullptr) cosine = std::min(cosine, -other->outward.dot(gap) / length);
  const double max_gap = other != nullptr ? options.max_facing_gap : options.max_gap;
  const double least = std::cos(other != nullptr ? options.max_facing_angle : options.max_angle);
  double reach = max_gap * (cosine - least) / (1 - least);
  if (cosine > 0) reach = std::max(reach, options.touch_distance);
  if (other == nullptr && length > reach && length < reach * (1 + options.evidence_gain)) {
    const Vec3& p = graph.edge(target.edge).points[target.index];
    reach *= 1 + options.evidence_gain * evidence.Share(end.position, p);
  }
  reach = std::min({reach, end.max_gap, other != nullptr ? other->max_gap : kForbidden});
  if (length > reach || LoopLength(graph, end, target) < options.min_loop) return kForbidden;
  return length / reach;
}

std::vector<Join> CandidateJoins(const SkeletonGraph& graph, const std::vector<FreeEnd>& ends,
                                 const GapEvidence& evidence, const FreeEndOptions& options) {
  std::vector<Vec3> positions;
  std::vector<CurvePoint> targets;
  for (const EdgeId id : graph.Edges()) {
    const Polyline& points = graph.edge(id).points;
    for (size_t i = 0; i < points.size(); ++i) {
      positions.push_back(points[i]);
      targets.push_back({id, static_cast<int>(i)});
    }
  }
  std::vector<const FreeEnd*> end_of_node;
  for (const FreeEnd& end : ends) {
    end_of_node.resize(std::max<size_t>(end_of_node.size(), end.node + 1), nullptr);
    end_of_node[end.node] = &end;
  }
  for (const NodeId node : graph.Nodes()) {
    end_of_node.resize(std::max<size_t>(end_of_node.size(), node + 1), nullptr);
  }
  const double reach =
      std::max((1 + options.evidence_gain) * options.max_gap, options.max_facing_gap);
  const PointGrid grid(positions, reach);
  std::vector<Join> joins;
  for (size_t e = 0; e < ends.size(); ++e) {
    grid.ForEachWithin(ends[e].position, reach, [&](int i, const Vec3&) {
      const double cost = JoinCost(graph, ends[e], targets[i], end_of_node, evidence, options);
      if (std::isfinite(cost)) {
        joins.push_back({cost, static_cast<int>(e), targets[i].edge, targets[i].index});
      }
    });
  }
  std::sort(joins.begin(), joins.end());
  return joins;
}

// The cheapest joins such that each end is used once.
std::vector<Join> SelectJoins(const SkeletonGraph& graph, const std::vector<FreeEnd>& ends,
                              const GapEvidence& evidence, const FreeEndOptions& options) {
  std::map<NodeId, char> used;
  std::vector<Join> selected;
  for (const Join& join : CandidateJoins(graph, ends, evidence, options)) {
    const NodeId from = ends[join.end].node;
    const NodeId to = NodeNear(graph, {join.edge, join.index}, options.snap_distance);
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

// A curve from a free end to a node: on in the end's direction, and in that of the node where it is
// a free end too (cubic Hermite).
Polyline BridgeCurve(const SkeletonGraph& graph, const FreeEnd& from, NodeId to,
                     const FreeEnd* other) {
  constexpr int kSegments = 12;
  const Vec3& a = from.position;
  const Vec3& b = graph.position(to);
  if (other == nullptr) return {a, b};
  const double length = (b - a).norm();
  const Vec3 start = length * from.outward;
  const Vec3 end = -length * other->outward;
  Polyline curve{a};
  for (int i = 1; i < kSegments; ++i) {
    const double t = static_cast<double>(i) / kSegments;
    const double u = 1 - t;
    curve.push_back((1 + 2 * t) * u * u * a + t * u * u * start + (3 - 2 * t) * t * t * b -
                    t * t * u * end);
  }
  curve.push_back(b);
  return curve;
}

}  // namespace

void VisitOptions(FreeEndOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"max_gap", "m", 0, 0.1, "Deviation: how far an end may reach for a curve straight ahead."},
      options.max_gap);
  visitor.Visit({"max_angle", "rad", 0.01, 1.6,
                 "Deviation: the angle at which an end reaches nothing any more."},
                options.max_angle);
  visitor.Visit({"max_gap_per_length", "", 0, 100,
                 "Deviation: how far an end may reach over the length of its edge: short pieces "
                 "are likelier to be noise."},
                options.max_gap_per_length);
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
  visitor.Visit({"max_facing_angle", "rad", 0.01, 1.6,
                 "Deviation: the angle at which two ends do not face each other any more."},
                options.max_facing_angle);
  visitor.Visit({"touch_distance", "m", 0, 0.1,
                 "Deviation: how far an end reaches ahead whatever the angle."},
                options.touch_distance);
  visitor.Visit({"fit_length", "m", 0.001, 0.5,
                 "Deviation: length of the end piece that gives its direction."},
                options.fit_length);
  visitor.Visit(
      {"tip_length", "m", 0, 0.1, "Deviation: so much of a free end is noise and straightened."},
      options.tip_length);
  visitor.Visit({"snap_distance", "m", 0, 0.1,
                 "Deviation: a bridge that meets a curve this near to its end ends there."},
                options.snap_distance);
  visitor.Visit({"min_loop", "m", 0, 1, "Deviation: bridges do not close shorter loops."},
                options.min_loop);
}

void StraightenTips(SkeletonGraph& graph, const FreeEndOptions& options) {
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) != 1) continue;
    Polyline points = PointsFrom(graph, node);
    if (Length(points) < options.tip_length + options.fit_length) continue;
    points = WithStraightTip(points, options.tip_length, options.fit_length);
    const EdgeId edge = graph.IncidentEdges(node)[0];
    graph.MoveNode(node, points.front());
    if (graph.edge(edge).nodes[0] != node) std::reverse(points.begin(), points.end());
    graph.SetCurve(edge, std::move(points));
  }
}

void CloseFreeEnds(SkeletonGraph& graph, const FreeEndOptions& options,
                   const ObservedPoints& points) {
  const std::vector<FreeEnd> ends = FreeEnds(graph, options);
  if (ends.empty()) return;
  const std::vector<Join> joins = SelectJoins(graph, ends, GapEvidence(points, options), options);
  std::map<NodeId, const FreeEnd*> end_of_node;
  for (const FreeEnd& end : ends) end_of_node[end.node] = &end;
  std::vector<std::pair<const FreeEnd*, NodeId>> bridges;
  std::map<EdgeId, std::map<int, std::vector<const FreeEnd*>, std::greater<>>> splits;
  for (const Join& join : joins) {
    const NodeId node = NodeNear(graph, {join.edge, join.index}, options.snap_distance);
    const FreeEnd* from = &ends[join.end];
    if (node >= 0) bridges.emplace_back(from, node);
    if (node < 0) splits[join.edge][join.index].push_back(from);
  }
  // From the back of each edge to its front, so that the indices of the front part stay.
  for (const auto& [edge, ends_of_index] : splits) {
    EdgeId front = edge;
    for (const auto& [index, sources] : ends_of_index) {
      const NodeId node = graph.SplitEdge(front, static_cast<size_t>(index));
      front = graph.IncidentEdges(node)[0];
      for (const FreeEnd* source : sources) bridges.emplace_back(source, node);
    }
  }
  for (const auto& [from, to] : bridges) {
    if (from->position == graph.position(to)) continue;
    const auto other = end_of_node.find(to);
    const FreeEnd* other_end = other == end_of_node.end() ? nullptr : other->second;
    graph.AddEdge({{from->node, to}, BridgeCurve(graph, *from, to, other_end), {}, {}});
  }
  graph.DissolveDegree2Nodes();
}

}  // namespace curvefusion
