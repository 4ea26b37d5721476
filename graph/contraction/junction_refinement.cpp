#include "graph/contraction/junction_refinement.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "graph/contraction/fork_placement.h"

namespace curvefusion {

namespace {

// Keeps the fit where all lines are nearly parallel; a full line pulls with weight 1.
constexpr double kPriorWeight = 0.02;
constexpr int kRounds = 2;

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

// The first points of a branch in order from its junction, as far as they can matter.
Polyline NearPoints(const SkeletonGraph& graph, const BranchEnd& end, double length) {
  const Polyline& points = graph.edge(end.edge).points;
  const size_t n = points.size();
  Polyline near;
  double arc_length = 0;
  for (size_t i = 0; i < n && arc_length <= length; ++i) {
    near.push_back(points[end.side == 0 ? i : n - 1 - i]);
    if (i > 0) arc_length += (near[i] - near[i - 1]).norm();
  }
  return near;
}

bool IsBlurred(const Vec3& p, const std::vector<Polyline>& branches, size_t own, double radius) {
  for (size_t other = 0; other < branches.size(); ++other) {
    if (other == own) continue;
    for (const Vec3& q : branches[other]) {
      if ((p - q).squaredNorm() < radius * radius) return true;
    }
  }
  return false;
}

// The stretch of a branch that lies clear of all others: [first, last) of its near points. Where
// wires part at a small angle it begins far from the junction. It ends before the far node's own
// blurred zone.
std::pair<size_t, size_t> ClearStretch(const SkeletonGraph& graph, const BranchEnd& end,
                                       const std::vector<Polyline>& branches, size_t own,
                                       const JunctionRefinementOptions& options) {
  const Polyline& points = branches[own];
  const NodeId far_node = graph.edge(end.edge).nodes[1 - end.side];
  const bool far_is_junction = graph.Degree(far_node) >= 3;
  const auto near_far_node = [&](const Vec3& p) {
    return far_is_junction && (p - graph.position(far_node)).norm() < options.inner_radius;
  };
  size_t first = points.size();
  while (first > 0 && !IsBlurred(points[first - 1], branches, own, options.inner_radius)) --first;
  size_t last = first;
  double length = 0;
  while (last < points.size() && length <= options.fit_length && !near_far_node(points[last])) {
    if (last > first) length += (points[last] - points[last - 1]).norm();
    ++last;
  }
  return {first, last};
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
                                    const JunctionRefinementOptions& options) {
  std::vector<Polyline> branches;
  for (const BranchEnd& end : ends) {
    branches.push_back(NearPoints(graph, end, options.reach + options.fit_length));
  }
  std::vector<BranchLine> lines;
  for (size_t i = 0; i < ends.size(); ++i) {
    const auto [first, last] = ClearStretch(graph, ends[i], branches, i, options);
    if (last - first < 3) continue;
    const Polyline stretch(branches[i].begin() + static_cast<std::ptrdiff_t>(first),
                           branches[i].begin() + static_cast<std::ptrdiff_t>(last));
    BranchLine line = FitLine(stretch);
    line.weight = std::min(1.0, 2 * Length(stretch) / options.fit_length);
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
  const JunctionFit fit =
      MeetingPoint(FitBranches(graph, BranchEnds(graph, nodes), options), start);
  if ((fit.position - start).norm() > options.reach) {
    return {start, std::numeric_limits<double>::infinity()};
  }
  return fit;
}

// The junction of two wires that part at a small angle, if that is what a node is.
std::optional<Vec3> FitFork(const SkeletonGraph& graph, NodeId node,
                            const JunctionRefinementOptions& options) {
  if (graph.Degree(node) != 3) return std::nullopt;
  JunctionRefinementOptions wide = options;
  wide.inner_radius = options.fork_clearance;
  wide.fit_length = options.fork_fit_length;
  const std::vector<BranchEnd> ends = BranchEnds(graph, {node});
  std::vector<Polyline> branches;
  for (const BranchEnd& end : ends) {
    branches.push_back(NearPoints(graph, end, wide.reach + wide.fit_length));
  }
  std::vector<ClearBranch> clear;
  for (size_t i = 0; i < ends.size(); ++i) {
    const auto [first, last] = ClearStretch(graph, ends[i], branches, i, wide);
    clear.push_back({branches[i], first, last});
  }
  return ForkPosition(clear, options.reach, options.max_residual);
}

// A branch runs straight from its junction, which has moved, to where it leaves the blurred zone
// around the junction's new and old places.
Polyline StraightenedBranch(const Polyline& branch, const Vec3& junction, double radius) {
  const double moved = (junction - branch.front()).norm();
  size_t nearest = 0;
  double arc_length = 0;
  for (size_t i = 1; i < branch.size() && arc_length <= moved + radius; ++i) {
    arc_length += (branch[i] - branch[i - 1]).norm();
    if ((branch[i] - junction).norm() < (branch[nearest] - junction).norm()) nearest = i;
  }
  size_t first = nearest;
  while (first + 1 < branch.size() && ((branch[first] - junction).norm() < radius ||
                                       (branch[first] - branch.front()).norm() < radius)) {
    ++first;
  }
  first = std::max<size_t>(first, 1);
  Polyline straightened{junction};
  straightened.insert(straightened.end(), branch.begin() + static_cast<std::ptrdiff_t>(first),
                      branch.end());
  return straightened;
}

void PlaceJunction(SkeletonGraph& graph, NodeId node, const Vec3& position,
                   const JunctionRefinementOptions& options) {
  std::vector<std::pair<BranchEnd, Polyline>> branches;
  for (const BranchEnd& end : BranchEnds(graph, {node})) {
    Polyline points = graph.edge(end.edge).points;
    if (end.side == 1) std::reverse(points.begin(), points.end());
    branches.emplace_back(end, StraightenedBranch(points, position, options.inner_radius));
  }
  graph.MoveNode(node, position);
  for (auto& [end, points] : branches) {
    const SkeletonEdge& edge = graph.edge(end.edge);
    if (edge.nodes[0] == edge.nodes[1]) continue;
    if (end.side == 1) std::reverse(points.begin(), points.end());
    graph.SetCurve(end.edge, std::move(points));
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
  const std::span<const EdgeId> incident = graph.IncidentEdges(a);
  for (const EdgeId id : std::vector<EdgeId>(incident.begin(), incident.end())) {
    if (graph.OtherEnd(id, a) == b && Length(graph.edge(id).points) < max_length) {
      graph.RemoveEdge(id);
    }
  }
}

// Merges pairs of junctions that lie in one blurred zone or whose branches meet at one point, the
// nearest first; false where there are none.
bool MergePairs(SkeletonGraph& graph, const JunctionRefinementOptions& options) {
  bool merged = false;
  for (const auto& [length, id] : ShortJunctionEdges(graph, options.merge_distance)) {
    if (!graph.HasEdge(id)) continue;
    const auto [a, b] = graph.edge(id).nodes;
    if (a == b) continue;  // an earlier merge has closed it to a loop
    const JunctionFit fit = FitJunction(graph, {a, b}, options);
    if (length > options.min_distance && fit.max_residual > options.max_residual) continue;
    RemoveEdgesBetween(graph, a, b, options.merge_distance);
    graph.MergeNodes(a, b);
    graph.MoveNode(a, fit.position);
    merged = true;
  }
  return merged;
}

void PlaceJunctions(SkeletonGraph& graph, const JunctionRefinementOptions& options) {
  std::vector<std::pair<NodeId, Vec3>> placed;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) < 3) continue;
    const std::optional<Vec3> fork = FitFork(graph, node, options);
    placed.emplace_back(node, fork ? *fork : FitJunction(graph, {node}, options).position);
  }
  for (const auto& [node, position] : placed) PlaceJunction(graph, node, position, options);
}

}  // namespace

void VisitOptions(JunctionRefinementOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"inner_radius", "m", 0, 0.1,
                 "Deviation: branches are not trusted nearer than this to a junction, where the "
                 "kernel blends them."},
                options.inner_radius);
  visitor.Visit({"fit_length", "m", 0.001, 0.5,
                 "Deviation: length of the lines fitted to branches beyond that."},
                options.fit_length);
  visitor.Visit({"reach", "m", 0.001, 0.5,
                 "Deviation: how far a junction may move, as it must where wires part at a small "
                 "angle."},
                options.reach);
  visitor.Visit(
      {"merge_distance", "m", 0, 0.5, "Deviation: junctions joined by a shorter edge may be one."},
      options.merge_distance);
  visitor.Visit({"min_distance", "m", 0, 0.5,
                 "Deviation: junctions joined by an edge shorter than this are one: the kernel "
                 "cannot tell them apart."},
                options.min_distance);
  visitor.Visit({"max_residual", "m", 0, 0.1,
                 "Deviation: greatest distance of a branch's line from a merged junction, and of "
                 "two wires where one forks off the other."},
                options.max_residual);
  visitor.Visit({"fork_clearance", "m", 0, 0.1,
                 "Deviation: wires that part at a small angle blend up to this distance."},
                options.fork_clearance);
  visitor.Visit({"fork_fit_length", "m", 0.001, 0.5,
                 "Deviation: length of the curves that are carried on to where such wires meet."},
                options.fork_fit_length);
}

void RefineJunctions(SkeletonGraph& graph, const JunctionRefinementOptions& options) {
  // Once placed, junctions may turn out to lie side by side.
  for (int round = 0; round < kRounds; ++round) {
    while (MergePairs(graph, options)) {
    }
    PlaceJunctions(graph, options);
  }
}

}  // namespace curvefusion
