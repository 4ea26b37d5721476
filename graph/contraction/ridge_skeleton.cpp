#include "graph/contraction/ridge_skeleton.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <vector>

#include "graph/connected_parts.h"
#include "graph/contraction/noise_edges.h"
#include "graph/intersections.h"
#include "graph/merge.h"
#include "graph/parallel_edges.h"
#include "graph/smoothing.h"

namespace curvefusion {

namespace {

// Minimises sum |v - v0|^2 + weight sum |v_(k-1) - 2 v_k + v_(k+1)|^2 with the ends held; a closed
// curve without a junction bends over its seam too.
Polyline Smoothed(const Polyline& points, double weight, bool closed) {
  const int n = static_cast<int>(points.size()) - (closed ? 1 : 0);
  if (n < 4) return points;
  constexpr double kHeld = 1e6;  // chosen: far above the weight of a point that may move, 1
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX3d target(n, 3);
  for (int i = 0; i < n; ++i) {
    const bool held = !closed && (i == 0 || i == n - 1);
    entries.emplace_back(i, i, held ? kHeld : 1.0);
    target.row(i) = (held ? kHeld : 1.0) * points[i].transpose();
    if (held) continue;
    const int at[3] = {(i + n - 1) % n, i, (i + 1) % n};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b)
        entries.emplace_back(at[a], at[b], weight * kSecondDifference[a] * kSecondDifference[b]);
    }
  }
  Eigen::SparseMatrix<double> system(n, n);
  system.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixX3d solved =
      Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(system).solve(target);
  Polyline smoothed = points;
  for (int i = closed ? 0 : 1; i < n - (closed ? 0 : 1); ++i) {
    smoothed[i] = solved.row(i).transpose();
  }
  if (closed) smoothed.back() = smoothed.front();
  return smoothed;
}

ObservedPoints FinitePoints(const ObservedPoints& points) {
  ObservedPoints finite;
  finite.Reserve(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    if (points.positions[i].allFinite()) finite.Add(points, i);
  }
  return finite;
}

// Smooths details shorter than about `length` away; nodes stay, but for those of closed curves.
void SmoothEdges(SkeletonGraph& graph, double length, double step) {
  const double weight = std::pow(length / step, 4);
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    const bool closed = edge.nodes[0] == edge.nodes[1] && graph.Degree(edge.nodes[0]) == 2;
    Polyline smoothed = Smoothed(Resample(edge.points, step), weight, closed);
    if (closed) graph.MoveNode(edge.nodes[0], smoothed.front());
    graph.SetCurve(id, std::move(smoothed));
  }
}

}  // namespace

void VisitOptions(RidgeOptions& options, OptionVisitor& visitor) {
  visitor.BeginSection("ridge_projection");
  VisitOptions(options.projection, visitor);
  visitor.BeginSection("curve_network");
  VisitOptions(options.network, visitor);
  visitor.BeginSection("free_ends");
  VisitOptions(options.free_ends, visitor);
  visitor.BeginSection("junction_refinement");
  VisitOptions(options.junctions, visitor);
  visitor.BeginSection("ridge_skeleton");
  visitor.Visit({"fragment_length", "m", 0, 1,
                 "Deviation: shorter pieces are dropped before gaps are closed."},
                options.fragment_length);
  visitor.Visit({"min_component", "m", 0, 10,
                 "Deviation: components with less curve are dropped at the end."},
                options.min_component);
  visitor.Visit(
      {"smoothing_length", "m", 0, 0.1, "Deviation: details shorter than this are smoothed away."},
      options.smoothing_length);
  visitor.Visit({"step", "m", 0.0002, 0.02, "Deviation: vertex distance of the curves."},
                options.step);
}

SkeletonGraph ExtractRidgeSkeleton(const ObservedPoints& points, const RidgeOptions& options) {
  return ExtractRidgeSkeleton(points, ProjectToRidges(points, options.projection), options);
}

SkeletonGraph ExtractRidgeSkeleton(const ObservedPoints& observed, const RidgePoints& ridge,
                                   const RidgeOptions& options) {
  const ObservedPoints points = FinitePoints(observed);
  SkeletonGraph graph = ConnectRidgePoints(ridge, options.network);
  DropNoiseEdges(graph, points, options.projection.contrast);
  DropSmallComponents(graph, options.fragment_length);
  SmoothEdges(graph, options.smoothing_length, options.step);
  StraightenTips(graph, options.free_ends);
  // Ends that miss a junction in its blurred place may meet it in its right one.
  for (int round = 0; round < 2; ++round) {
    CloseFreeEnds(graph, options.free_ends, points);
    DropNoiseEdges(graph, points, options.projection.contrast);
    RefineJunctions(graph, options.junctions);
    MergeParallelEdges(graph, options.junctions.min_distance);
    DropShortLoops(graph, options.network.min_loop);
  }
  PruneSpurs(graph, options.network.min_spur);
  DropSmallComponents(graph, options.min_component);
  SmoothEdges(graph, options.smoothing_length, options.step);
  ResolveIntersections(graph, 0);  // curves that touch in a point become a junction
  return graph;
}

SkeletonGraph ExtractRidgeSkeleton(const ObservedPoints& points, const RidgeOptions& options,
                                   const AffineTransform& T_space_world) {
  const AffineTransform T_world_space = T_space_world.inverse();
  SkeletonGraph skeleton =
      Transformed(ExtractRidgeSkeleton(Transformed(points, T_space_world), options), T_world_space);
  // Noise that turns ends aside is stretched with them.
  const double stretch = T_world_space.linear().operatorNorm();
  if (stretch > 1) {
    FreeEndOptions free_ends = options.free_ends;
    free_ends.tip_length *= stretch;
    StraightenTips(skeleton, free_ends);
    ResolveIntersections(skeleton, 0);
  }
  return skeleton;
}

void TidyRidgeSkeleton(SkeletonGraph& graph, const RidgeOptions& options) {
  MergeHubs(graph, options.junctions);
  DropShortLoops(graph, options.network.min_loop);
  PruneSpurs(graph, options.network.min_spur);
  DropSmallComponents(graph, options.min_component);
  ResolveIntersections(graph, 0);
}

}  // namespace curvefusion
