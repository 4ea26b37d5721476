#include "graph/contraction/junction_refinement.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "graph/contraction/fork_placement.h"
#include "graph/contraction/junction_fit.h"
#include "graph/edge_curve.h"

namespace curvefusion {

namespace {

constexpr int kRounds = 2;  // chosen: once placed, junctions may lie side by side
// With four lines, a point that three nodes share by chance is told from a junction; and chosen:
// on training scans umbrella 1, the shared umbrella and wheel 1, parts of a hub meet to .7 to 1.5
// mm, junctions next to each other to 2.5 and more (docs/lab_notebook.md).
constexpr int kHubLines = 4;
constexpr double kHubDeviation = 0.002;
constexpr double kStep = 0.0015;  // metres; between points of curves

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

// A branch, whose first point is its junction, runs straight from the junction, which has moved, to
// where it leaves the blurred zone around the junction's new and old places.
void StraightenBranch(const Vec3& junction, double radius, SkeletonEdge& branch) {
  const Polyline& points = branch.points;
  const double moved = (junction - points.front()).norm();
  size_t nearest = 0;
  double arc_length = 0;
  for (size_t i = 1; i < points.size() && arc_length <= moved + radius; ++i) {
    arc_length += (points[i] - points[i - 1]).norm();
    if ((points[i] - junction).norm() < (points[nearest] - junction).norm()) nearest = i;
  }
  size_t first = nearest;
  while (first + 1 < points.size() && ((points[first] - junction).norm() < radius ||
                                       (points[first] - points.front()).norm() < radius)) {
    ++first;
  }
  first = std::max<size_t>(first, 1);
  branch = PartOf(branch, first - 1, points.size() - 1, branch.nodes);
  branch.points.front() = junction;
}

void PlaceJunction(SkeletonGraph& graph, NodeId node, const Vec3& position,
                   const JunctionRefinementOptions& options) {
  std::vector<std::pair<BranchEnd, SkeletonEdge>> branches;
  for (const BranchEnd& end : BranchEnds(graph, {node})) {
    SkeletonEdge branch = graph.edge(end.edge);
    if (branch.nodes[0] == branch.nodes[1]) continue;
    if (end.side == 1) Reverse(branch);
    StraightenBranch(position, options.inner_radius, branch);
    if (end.side == 1) Reverse(branch);
    branches.emplace_back(end, std::move(branch));
  }
  graph.MoveNode(node, position);
  for (auto& [end, branch] : branches) {
    graph.SetCurve(end.edge, std::move(branch.points), std::move(branch.radii),
                   std::move(branch.observations));
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

// Straightened stretches have no points.
void ResampleBranches(NodeId node, SkeletonGraph& graph) {
  for (const BranchEnd& end : BranchEnds(graph, {node})) {
    SkeletonEdge edge = Resampled(graph.edge(end.edge), kStep);
    graph.SetCurve(end.edge, std::move(edge.points), std::move(edge.radii),
                   std::move(edge.observations));
  }
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
  visitor.Visit({"fork_fit_length", "m", 0.001, 0.5,
                 "Deviation: length of the curves that are carried on to where such wires meet."},
                options.fork_fit_length);
}

void PlaceByLines(SkeletonGraph& graph, NodeId node, int least_lines,
                  const JunctionRefinementOptions& options) {
  const JunctionFit fit = FitJunction(graph, {node}, options);
  if (fit.lines < least_lines) return;
  PlaceJunction(graph, node, fit.position, options);
  ResampleBranches(node, graph);
}

void MergeHubs(SkeletonGraph& graph, const JunctionRefinementOptions& options) {
  for (bool merged = true; merged;) {
    merged = false;
    for (const auto& [length, id] : ShortJunctionEdges(graph, options.merge_distance)) {
      if (!graph.HasEdge(id)) continue;
      const auto [a, b] = graph.edge(id).nodes;
      if (a == b) continue;  // an earlier merge has closed it to a loop
      const JunctionFit fit = FitJunction(graph, {a, b}, options);
      if (fit.lines < kHubLines || fit.deviation > kHubDeviation) continue;
      RemoveEdgesBetween(graph, a, b, options.merge_distance);
      graph.MergeNodes(a, b);
      PlaceJunction(graph, a, fit.position, options);
      ResampleBranches(a, graph);
      merged = true;
    }
  }
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
