#include "graph/contraction/junction_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {

namespace {

// Keeps the fit where all lines are nearly parallel. Chosen: little, as a full line pulls with
// weight 1.
constexpr double kPriorWeight = 0.02;

// A branch as a straight line near its junction.
struct BranchLine {
  Vec3 point;
  Vec3 direction;
  double weight;
};

bool IsBlurred(const Vec3& p, const std::vector<Polyline>& branches, size_t own, double radius) {
  for (size_t other = 0; other < branches.size(); ++other) {
    if (other == own) continue;
    for (const Vec3& q : branches[other]) {
      if ((p - q).squaredNorm() < radius * radius) return true;
    }
  }
  return false;
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
  JunctionFit fit{a.inverse() * b, static_cast<int>(lines.size()), 0, 0};
  double weights = 0, squares = 0;
  for (const BranchLine& line : lines) {
    const Vec3 d = fit.position - line.point;
    const double residual = (d - line.direction.dot(d) * line.direction).norm();
    fit.max_residual = std::max(fit.max_residual, residual);
    weights += line.weight;
    squares += line.weight * residual * residual;
  }
  const double redundancy = 2 * weights - 3;
  fit.deviation =
      redundancy > 0 ? std::sqrt(squares / redundancy) : std::numeric_limits<double>::infinity();
  return fit;
}

}  // namespace

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

JunctionFit FitJunction(const SkeletonGraph& graph, const std::vector<NodeId>& nodes,
                        const JunctionRefinementOptions& options) {
  Vec3 start = Vec3::Zero();
  for (const NodeId node : nodes) start += graph.position(node);
  start /= static_cast<double>(nodes.size());
  const JunctionFit fit =
      MeetingPoint(FitBranches(graph, BranchEnds(graph, nodes), options), start);
  if ((fit.position - start).norm() > options.reach) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return {start, 0, kNone, kNone};
  }
  return fit;
}

}  // namespace curvefusion
