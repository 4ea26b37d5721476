#include "graph/junction_refinement.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

// Keeps the fit where all lines are nearly parallel; a full line pulls with weight 1.
constexpr double kPriorWeight = 0.02;
constexpr int kFitRounds = 3;

// A branch as a straight line near its junction.
struct BranchLine {
  Vec3 point;
  Vec3 direction;
  double weight;
};

// One end of an edge: side 0 leaves from nodes[0], side 1 from nodes[1].
struct BranchEnd {
  EdgeId edge;
  int side;
};

struct JunctionFit {
  Vec3 position;
  double max_residual = 0;
};

std::vector<BranchEnd> BranchEnds(const SkeletonGraph& graph, const std::vector<NodeId>& nodes) {
  const auto inside = [&nodes](NodeId node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  };
  std::vector<BranchEnd> ends;
  for (const NodeId node : nodes) {
    EdgeId before = -1;
    for (const EdgeId id : graph.IncidentEdges(node)) {
      const SkeletonEdge& edge = graph.edge(id);
      const bool loop = edge.nodes[0] == edge.nodes[1];
      if (!loop && inside(edge.nodes[0]) && inside(edge.nodes[1])) continue;
      const int side = loop ? (id == before ? 1 : 0) : (edge.nodes[0] == node ? 0 : 1);
      ends.push_back({id, side});
      before = id;
    }
  }
  return ends;
}

// The points of a branch between the two spheres around the centre, in order from the junction.
// Ends at the far node's own blurred zone.
std::vector<Vec3> FitZone(const SkeletonGraph& graph, const BranchEnd& end, const Vec3& center,
                          const JunctionRefinementOptions& options) {
  const SkeletonEdge& edge = graph.edge(end.edge);
  const NodeId far_node = edge.nodes[1 - end.side];
  const bool far_is_junction = graph.Degree(far_node) >= 3;
  const int n = static_cast<int>(edge.points.size());
  std::vector<Vec3> zone;
  for (int i = 0; i < n; ++i) {
    const Vec3& p = edge.points[end.side == 0 ? i : n - 1 - i];
    const double distance = (p - center).norm();
    if (distance > options.outer_radius && !zone.empty()) break;
    const bool blurred =
        far_is_junction && (p - graph.position(far_node)).norm() < options.inner_radius;
    if (blurred && !zone.empty()) break;
    if (distance >= options.inner_radius && !blurred) zone.push_back(p);
  }
  return zone;
}

BranchLine FitLine(const std::vector<Vec3>& points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Mat3 scatter = Mat3::Zero();
  for (const Vec3& p : points) scatter += (p - mean) * (p - mean).transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(scatter);
  return {mean, solver.eigenvectors().col(2), 1.0};
}

std::vector<BranchLine> FitBranches(const SkeletonGraph& graph, const std::vector<BranchEnd>& ends,
                                    const Vec3& center, const JunctionRefinementOptions& options) {
  std::vector<BranchLine> lines;
  for (const BranchEnd& end : ends) {
    const std::vector<Vec3> zone = FitZone(graph, end, center, options);
    if (zone.size() < 3) continue;
    BranchLine line = FitLine(zone);
    const double full = options.outer_radius - options.inner_radius;
    line.weight = std::min(1.0, 2 * (zone.back() - zone.front()).norm() / full);
    lines.push_back(line);
  }
  return lines;
}

// The point with the least weighted sum of squared distances to the lines.
JunctionFit MeetingPoint(const std::vector<BranchLine>& lines, const Vec3& prior) {
  Mat3 a = kPriorWeight * Mat3::Identity();
  Vec3 b = kPriorWeight * prior;
  for (const BranchLine& line : lines) {
    const Mat3 across = Mat3::Identity() - line.direction * line.direction.transpose();
    a += line.weight * across;
    b += line.weight * across * line.point;
  }
  JunctionFit fit{a.inverse() * b, 0};
  for (const BranchLine& line : lines) {
    const Vec3 d = fit.position - line.point;
    fit.max_residual =
        std::max(fit.max_residual, (d - line.direction.dot(d) * line.direction).norm());
  }
  return fit;
}

JunctionFit FitJunction(const SkeletonGraph& graph, const std::vector<NodeId>& nodes,
                        const JunctionRefinementOptions& options) {
  Vec3 start = Vec3::Zero();
  for (const NodeId node : nodes) start += graph.position(node);
  start /= static_cast<double>(nodes.size());
  const std::vector<BranchEnd> ends = BranchEnds(graph, nodes);
  JunctionFit fit{start, 0};
  for (int round = 0; round < kFitRounds; ++round) {
    fit = MeetingPoint(FitBranches(graph, ends, fit.position, options), start);
    if ((fit.position - start).norm() > options.max_move) {
      return {start, std::numeric_limits<double>::infinity()};
    }
  }
  return fit;
}

// A branch runs straight from its junction to where it leaves the blurred zone.
void StraightenEnd(SkeletonGraph& graph, const BranchEnd& end, double radius) {
  Polyline points = graph.edge(end.edge).points;
  if (end.side == 1) std::reverse(points.begin(), points.end());
  size_t first = 1;
  while (first + 1 < points.size() && (points[first] - points[0]).norm() < radius) ++first;
  points.erase(points.begin() + 1, points.begin() + static_cast<std::ptrdiff_t>(first));
  if (end.side == 1) std::reverse(points.begin(), points.end());
  graph.SetCurve(end.edge, std::move(points));
}

void PlaceJunction(SkeletonGraph& graph, NodeId node, const Vec3& position,
                   const JunctionRefinementOptions& options) {
  graph.MoveNode(node, position);
  for (const BranchEnd& end : BranchEnds(graph, {node})) {
    StraightenEnd(graph, end, options.inner_radius);
  }
}

std::vector<std::pair<double, EdgeId>> ShortJunctionEdges(const SkeletonGraph& graph,
                                                          double max_length) {
  std::vector<std::pair<double, EdgeId>> edges;
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    const double length = Length(edge.points);
    if (edge.nodes[0] == edge.nodes[1] || length >= max_length) continue;
    if (graph.Degree(edge.nodes[0]) < 3 || graph.Degree(edge.nodes[1]) < 3) continue;
    edges.emplace_back(length, id);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void RemoveEdgesBetween(SkeletonGraph& graph, NodeId a, NodeId b, double max_length) {
  const std::vector<EdgeId> incident = graph.IncidentEdges(a);
  for (const EdgeId id : incident) {
    const SkeletonEdge& edge = graph.edge(id);
    const NodeId other = edge.nodes[0] == a ? edge.nodes[1] : edge.nodes[0];
    if (other == b && Length(edge.points) < max_length) graph.RemoveEdge(id);
  }
}

// Merges one pair of junctions whose branches meet at one point; false where there is none.
bool MergeOnePair(SkeletonGraph& graph, const JunctionRefinementOptions& options) {
  for (const auto& [length, id] : ShortJunctionEdges(graph, options.merge_distance)) {
    const NodeId a = graph.edge(id).nodes[0];
    const NodeId b = graph.edge(id).nodes[1];
    const JunctionFit fit = FitJunction(graph, {a, b}, options);
    if (fit.max_residual > options.max_residual) continue;
    RemoveEdgesBetween(graph, a, b, options.merge_distance);
    graph.MergeNodes(a, b);
    graph.MoveNode(a, fit.position);
    return true;
  }
  return false;
}

}  // namespace

void VisitOptions(JunctionRefinementOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"inner_radius", "m", 0, 0.1,
                 "Deviation: branches are not trusted nearer than this to a junction, where the "
                 "kernel blends them."},
                options.inner_radius);
  visitor.Visit({"outer_radius", "m", 0.001, 0.5,
                 "Deviation: lines are fitted to branches up to this distance from a junction."},
                options.outer_radius);
  visitor.Visit(
      {"merge_distance", "m", 0, 0.5, "Deviation: junctions joined by a shorter edge may be one."},
      options.merge_distance);
  visitor.Visit({"max_residual", "m", 0, 0.1,
                 "Deviation: greatest distance of a branch's line from a merged junction."},
                options.max_residual);
  visitor.Visit(
      {"max_move", "m", 0, 0.5, "Deviation: a junction that would move farther stays where it is."},
      options.max_move);
}

void RefineJunctions(SkeletonGraph& graph, const JunctionRefinementOptions& options) {
  while (MergeOnePair(graph, options)) {
  }
  graph.RemoveIsolatedNodes();
  std::vector<std::pair<NodeId, Vec3>> placed;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) < 3) continue;
    placed.emplace_back(node, FitJunction(graph, {node}, options).position);
  }
  for (const auto& [node, position] : placed) PlaceJunction(graph, node, position, options);
}

}  // namespace curvefusion
