#include <gtest/gtest.h>

#include <random>

#include "graph/graph_smoother.h"
#include "graph/validate.h"
#include "kernel/error.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

double RmsDistance(const Polyline& points, const Polyline& truth) {
  double sum = 0;
  for (const Vec3& p : points) sum += std::pow(Project(truth, p).distance, 2);
  return std::sqrt(sum / static_cast<double>(points.size()));
}

SmoothingOptions Literal() { return PaperSmoothingOptions(); }

TEST(SmoothGraph, AnEmptyGraphStaysEmpty) { EXPECT_TRUE(SmoothGraph(SkeletonGraph(), {}).empty()); }

TEST(SmoothGraph, WhatWouldTakeMoreThanAMillionStepsIsRefused) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {1001, 0, 0}});  // a million steps of 1 mm, and a metre
  EXPECT_THROW(SmoothGraph(graph, {}), Error);
}

TEST(SmoothGraph, AStraightLineStaysAndKeepsItsLength) {
  for (const SmoothingOptions& options : {Literal(), SmoothingOptions()}) {
    SkeletonGraph graph;
    graph.AddPolyline({{0, 0, 0}, {0.03, 0, 0}, {0.1, 0, 0}});
    const SkeletonGraph smooth = SmoothGraph(graph, options);
    EXPECT_EQ(smooth.edge(0).points.size(), 101u);
    // Second differences of a line vanish: rounding of the solution only (condition < 1e4).
    EXPECT_NEAR(smooth.TotalLength(), 0.1, 1e-12);
    EXPECT_LT(MaxDistance(smooth, graph), 1e-12);
  }
}

TEST(SmoothGraph, ANoisyHelixGetsNearerToTheTruth) {
  SkeletonGraph truth;
  truth.AddPolyline(Helix(0.04, 0.03, 2));
  SkeletonGraph sampled;
  sampled.AddPolyline(Resample(truth.edge(0).points, 0.001));
  const SkeletonGraph noisy = Perturbed(sampled, RigidTransform::Identity(), 0.0005, 3);
  const SkeletonGraph smooth = SmoothGraph(noisy, Literal());
  const double before = RmsDistance(noisy.edge(0).points, truth.edge(0).points);
  const double after = RmsDistance(smooth.edge(0).points, truth.edge(0).points);
  // Resampling shortens the zigzag, the fit averages over about (4 * 60)^(1/4) = 4 vertices each
  // way: the noise must fall to less than half.
  EXPECT_LT(after, 0.5 * before);
}

TEST(SmoothGraph, ARingStaysClosedAndShrinksAsTheorySays) {
  constexpr int kPoints = 157;
  const double radius = 0.001 / (2 * std::sin(M_PI / kPoints));  // steps of exactly 1 mm
  SkeletonGraph graph;
  graph.AddPolyline(Ring(radius, kPoints));
  // The circle is an eigenvector of the second difference; twicing squares what is lost.
  const double eigenvalue = 2 - 2 * std::cos(2 * M_PI / kPoints);
  const double kept = 1 / (1 + 60 * eigenvalue * eigenvalue);
  for (const bool keep_curvature : {false, true}) {
    SmoothingOptions options;
    options.keep_curvature = keep_curvature;
    const SkeletonGraph smooth = SmoothGraph(graph, options);
    const Polyline& points = smooth.edge(0).points;
    EXPECT_EQ(points.front(), points.back());
    ASSERT_EQ(points.size(), kPoints + 1u);
    const double expected = radius * (keep_curvature ? 1 - (1 - kept) * (1 - kept) : kept);
    // Rounding of the arc length, against a shrinkage of 4 um or 0.6 nm.
    for (const Vec3& p : points) EXPECT_NEAR(p.norm(), expected, 1e-11);
  }
}

TEST(SmoothGraph, AYKeepsItsJunctionShared) {
  const SkeletonGraph noisy = Perturbed(YShape(0.05), RigidTransform::Identity(), 0.0004, 5);
  const SkeletonGraph smooth = SmoothGraph(noisy, SmoothingOptions());
  EXPECT_TRUE(Violations(smooth, 0).empty());
  ASSERT_EQ(CountDegree(smooth, 3), 1);
  EXPECT_EQ(smooth.edge_count(), 3);
  // By symmetry the junction of the true Y would not move; the noise is 0.4 mm.
  EXPECT_LT(smooth.position(0).norm(), 0.001);
}

TEST(SmoothGraph, FreeEndsAreHeldOnlyOnRequest) {
  SkeletonGraph graph;
  graph.AddPolyline(Resample(Helix(0.01, 0, 0.5), 0.001));
  const Vec3 start = graph.position(0);
  SmoothingOptions options;
  EXPECT_EQ(SmoothGraph(graph, options).position(0), start);
  options.hold_free_ends = false;
  EXPECT_GT((SmoothGraph(graph, options).position(0) - start).norm(), 1e-5);
}

TEST(SmoothGraph, ACornerIsKeptOnlyOnRequest) {
  SkeletonGraph graph;
  graph.AddPolyline({{0.05, 0, 0}, {0, 0, 0}, {0, 0.0503, 0}});
  const auto corner_error = [&graph](const SmoothingOptions& options) {
    return Project(SmoothGraph(graph, options).edge(0).points, Vec3::Zero()).distance;
  };
  EXPECT_LT(corner_error(SmoothingOptions()), 1e-9);  // straight on both sides: nothing to smooth
  EXPECT_GT(corner_error(Literal()), 0.0005);
}

TEST(SmoothGraph, ABendOfAWireIsNoCorner) {
  SkeletonGraph graph;
  graph.AddPolyline(Resample(Helix(0.012, 0, 0.5), 0.001));
  SmoothingOptions no_corners;
  no_corners.corner_angle = M_PI;
  EXPECT_EQ(SmoothGraph(graph, SmoothingOptions()).edge(0).points,
            SmoothGraph(graph, no_corners).edge(0).points);
}

TEST(GraphSmoother, AnalysesEachStructureOnce) {
  const SkeletonGraph first = Lattice(3, 3, 0.05);
  const SkeletonGraph second = Perturbed(first, RigidTransform::Identity(), 1e-6, 1);
  GraphSmoother smoother;
  SmoothingOptions options;
  options.hold_free_ends = false;
  for (const SkeletonGraph& graph : {first, second, first}) {
    const SkeletonGraph smooth = smoother.Smooth(graph, options);
    const SkeletonGraph expected = SmoothGraph(graph, options);
    for (const EdgeId id : graph.Edges())
      EXPECT_EQ(smooth.edge(id).points, expected.edge(id).points);
  }
  EXPECT_EQ(smoother.analyses(), 1);
  smoother.Smooth(YShape(0.05), options);
  EXPECT_EQ(smoother.analyses(), 2);
}

TEST(SmoothGraph, AttributesAreCarriedAlong) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0.1, 0, 0}});
  graph.SetCurve(0, {{0, 0, 0}, {0.1, 0, 0}}, {0.001, 0.003}, {2, 4});
  const SkeletonEdge smooth = SmoothGraph(graph, {}).edge(0);
  EXPECT_NEAR(smooth.radii[50], 0.002, 1e-12);
  EXPECT_NEAR(smooth.observations[50], 3, 1e-9);
}

}  // namespace
}  // namespace curvefusion
