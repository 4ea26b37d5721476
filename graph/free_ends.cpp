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

struct FreeEnd {
  NodeId node;
  EdgeId edge;
  Vec3 position;
  Vec3 outward;
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
  return {node, graph.IncidentEdges(node)[0], points.front(),
          (points.front() - inner).normalized()};
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
  const NodeId root = from.nodes[0] == end.node ? from.nodes[1] : from.nodes[0];
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

// What a join costs: its length over how far the end may reach in that direction; infinite where it
// is not allowed.
double JoinCost(const SkeletonGraph& graph, const FreeEnd& end, const CurvePoint& target,
                const std::vector<const FreeEnd*>& end_of_node, const FreeEndOptions& options) {
  constexpr double kForbidden = std::numeric_limits<double>::infinity();
  const Vec3 gap = graph.edge(target.edge).points[target.index] - end.position;
  const double length = gap.norm();
  const NodeId node = NodeNear(graph, target, options.snap_distance);
  if (node == end.node || length <= 0) return kForbidden;
  const FreeEnd* other = node >= 0 ? end_of_node[node] : nullptr;
  double cosine = end.outward.dot(gap) / length;
  if (other != nullptr) cosine = std::min(cosine, -other->outward.dot(gap) / length);
  const double max_gap = other != nullptr ? options.max_facing_gap : options.max_gap;
  const double least = std::cos(other != nullptr ? options.max_facing_angle : options.max_angle);
  double reach = max_gap * (cosine - least) / (1 - least);
  if (cosine > 0) reach = std::max(reach, options.touch_distance);
  if (length > reach || LoopLength(graph, end, target) < options.min_loop) return kForbidden;
  return length / reach;
}

std::vector<Join> CandidateJoins(const SkeletonGraph& graph, const std::vector<FreeEnd>& ends,
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
  std::vector<const FreeEnd*> end_of_node;
  for (const FreeEnd& end : ends) {
    end_of_node.resize(std::max<size_t>(end_of_node.size(), end.node + 1), nullptr);
    end_of_node[end.node] = &end;
  }
  for (const NodeId node : graph.Nodes()) {
    end_of_node.resize(std::max<size_t>(end_of_node.size(), node + 1), nullptr);
  }
  const double reach = std::max(options.max_gap, options.max_facing_gap);
  const PointGrid grid(positions, reach);
  std::vector<Join> joins;
  for (size_t e = 0; e < ends.size(); ++e) {
    grid.ForEachWithin(ends[e].position, reach, [&](int i, const Vec3&) {
      const double cost = JoinCost(graph, ends[e], targets[i], end_of_node, options);
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
                              const FreeEndOptions& options) {
  std::map<NodeId, char> used;
  std::vector<Join> selected;
  for (const Join& join : CandidateJoins(graph, ends, options)) {
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

}  // namespace

void VisitOptions(FreeEndOptions& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"max_gap", "m", 0, 0.1, "Deviation: how far an end may reach for a curve straight ahead."},
      options.max_gap);
  visitor.Visit({"max_angle", "rad", 0.01, 1.6,
                 "Deviation: the angle at which an end reaches nothing any more."},
                options.max_angle);
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

void CloseFreeEnds(SkeletonGraph& graph, const FreeEndOptions& options) {
  const std::vector<FreeEnd> ends = FreeEnds(graph, options);
  const std::vector<Join> joins = SelectJoins(graph, ends, options);
  std::vector<std::pair<NodeId, NodeId>> bridges;
  std::map<EdgeId, std::map<int, std::vector<NodeId>, std::greater<>>> splits;
  for (const Join& join : joins) {
    const NodeId node = NodeNear(graph, {join.edge, join.index}, options.snap_distance);
    const NodeId from = ends[join.end].node;
    if (node >= 0) bridges.emplace_back(from, node);
    if (node < 0) splits[join.edge][join.index].push_back(from);
  }
  // From the back of each edge to its front, so that the indices of the front part stay.
  for (const auto& [edge, nodes_of_index] : splits) {
    EdgeId front = edge;
    for (const auto& [index, sources] : nodes_of_index) {
      const NodeId node = graph.SplitEdge(front, static_cast<size_t>(index));
      front = graph.IncidentEdges(node)[0];
      for (const NodeId source : sources) bridges.emplace_back(source, node);
    }
  }
  for (const auto& [from, to] : bridges) {
    if (graph.position(from) == graph.position(to)) continue;
    graph.AddEdge({{from, to}, {graph.position(from), graph.position(to)}, {}, {}});
  }
  graph.DissolveDegree2Nodes();
}

}  // namespace curvefusion
