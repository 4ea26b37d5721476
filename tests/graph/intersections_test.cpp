#include "graph/intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "graph/io/graph_io.h"
#include "graph/validate.h"
#include "kernel/error.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

constexpr double kThreshold = 3 * kMillimetre;

// Resolves, and checks what must hold for every graph.
SkeletonGraph Resolved(SkeletonGraph graph) {
  ResolveIntersections(graph, kThreshold);
  EXPECT_EQ(Violations(graph, kThreshold), std::vector<std::string>());
  SkeletonGraph again = graph;
  ResolveIntersections(again, kThreshold);
  EXPECT_EQ(SkeletonToJson(graph), SkeletonToJson(again)) << "not idempotent";
  return graph;
}

TEST(ResolveIntersections, ACrossingBecomesOneJunctionOfValenceFour) {
  for (const double step : {0.2, 0.001}) {
    SkeletonGraph graph;
    graph.AddPolyline(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}, step));
    graph.AddPolyline(StraightLine({0, -0.05, 0.002}, {0, 0.05, 0.002}, step));
    const SkeletonGraph resolved = Resolved(graph);
    EXPECT_EQ(resolved.edge_count(), 4);
    EXPECT_EQ(CountDegree(resolved, 4), 1);
    EXPECT_EQ(CountDegree(resolved, 1), 4);
    EXPECT_LT(MaxDistance(resolved, graph), 0.001 + 1e-12);  // half the distance of the curves
  }
}

// The curve is there twice, once with the middles of its segments as vertices, so that lengths
// along it are summed differently and the mean of the two is beside it by rounding; others touch it
// in these middles. Multiples of 1/32 are exact.
TEST(ResolveIntersections, CurvesThatTouchOneOfTwoThatBecomeOneStayWithIt) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> sixteenths(0, 16);
  for (int round = 0; round < 20; ++round) {
    Polyline curve, twin;
    SkeletonGraph graph;
    for (int i = 0; i < 6; ++i) {
      curve.push_back(Vec3(sixteenths(random), sixteenths(random), sixteenths(random)) / 16);
      if (i > 0) {
        twin.push_back((curve[i - 1] + curve[i]) / 2);
        graph.AddPolyline({twin.back(), twin.back() + Vec3(i, 0, 30)});
      }
      twin.push_back(curve.back());
    }
    graph.AddPolyline(curve);
    const EdgeId heavier = graph.AddPolyline(twin);
    graph.SetCurve(heavier, twin, {}, std::vector<double>(twin.size(), 9.0));
    ResolveIntersections(graph, 0);
    EXPECT_EQ(Violations(graph, 0), std::vector<std::string>());
    EXPECT_EQ(graph.ComponentCount(), 1) << round;
  }
}

// A closed curve of less than what rounding is taken for holds two others together.
TEST(ResolveIntersections, ATinyLoopBetweenCurvesIsNotLostBeforeTheyAreTied) {
  const double size = std::ldexp(1.0, -48);
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, 0, 0}});
  graph.AddPolyline({{-1, 0, 0}, {0, 0, 0}});
  graph.AddPolyline({{1, 1, 0}, {size, size, 0}});
  ResolveIntersections(graph, 0);
  EXPECT_EQ(Violations(graph, 0), std::vector<std::string>());
  EXPECT_EQ(graph.ComponentCount(), 1);
}

TEST(ResolveIntersections, ATouchingEndBecomesATJunction) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}));
  graph.AddPolyline(StraightLine({0, 0.002, 0}, {0, 0.05, 0}));
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(resolved.edge_count(), 3);
  EXPECT_EQ(CountDegree(resolved, 3), 1);
}

TEST(ResolveIntersections, EndsThatMeetBecomeOneCurve) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.05, 0, 0}));
  graph.AddPolyline(StraightLine({0.052, 0, 0}, {0.1, 0, 0}));
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(resolved.edge_count(), 1);
  EXPECT_NEAR(resolved.TotalLength(), 0.1, 1e-12);  // straight: rounding only
}

TEST(ResolveIntersections, ALoopIsClosedByAJunctionWithItself) {
  const Polyline loop = {
      {-0.05, -0.05, 0}, {0.05, 0.05, 0}, {-0.05, 0.05, 0.002}, {0.05, -0.05, 0.002}};
  SkeletonGraph graph;
  graph.AddPolyline(Resample(loop, 0.001));
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(resolved.edge_count(), 3);
  EXPECT_EQ(resolved.CycleRank(), 1);
  EXPECT_EQ(CountDegree(resolved, 4), 1);
}

TEST(ResolveIntersections, NothingIsFineNotANumberIsRejected) {
  EXPECT_TRUE(Resolved({}).empty());
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0, NAN, 0}, {1, 0, 0}});
  EXPECT_THROW(ResolveIntersections(graph, kThreshold), Error);
}

TEST(ResolveIntersections, SeparateCurvesStayUntouched) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  graph.AddPolyline(StraightLine({0, 0.0031, 0}, {0.1, 0.0031, 0}));
  graph.AddPolyline(Ring(0.05, 300, {0.3, 0, 0}));
  EXPECT_EQ(SkeletonToJson(Resolved(graph)), SkeletonToJson(graph));
}

TEST(ResolveIntersections, AWireLatticeOfSinglePiecesGetsAllItsCrossings) {
  constexpr int kWires = 6;
  SkeletonGraph graph;
  for (int i = 0; i < kWires; ++i) {
    graph.AddPolyline(StraightLine({-0.01, 0.02 * i, 0}, {0.02 * kWires, 0.02 * i, 0}));
    graph.AddPolyline(StraightLine({0.02 * i, -0.01, 0.001}, {0.02 * i, 0.02 * kWires, 0.001}));
  }
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(CountDegree(resolved, 4), kWires * kWires);
  EXPECT_EQ(resolved.CycleRank(), (kWires - 1) * (kWires - 1));
  EXPECT_EQ(resolved.ComponentCount(), 1);
}

TEST(ResolveIntersections, DoubledCurvesBecomeOneWithTheirTails) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  graph.AddPolyline(StraightLine({0.04, 0.002, 0}, {0.2, 0.002, 0}));
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(resolved.CycleRank(), 0);
  EXPECT_EQ(resolved.edge_count(), 1);
  // 0.2 m from end to end; the ends of the overlap may be off by a threshold each.
  EXPECT_NEAR(resolved.TotalLength(), 0.2, 2 * kThreshold);
}

TEST(ResolveIntersections, AnAcuteForkIsZippedUp) {
  SkeletonGraph graph;
  const NodeId node = graph.AddNode(Vec3::Zero());
  for (const double angle : {-0.05, 0.05, M_PI}) {
    const Vec3 tip = 0.1 * Vec3(std::cos(angle), std::sin(angle), 0);
    Connect(graph, node, graph.AddNode(tip), StraightLine(Vec3::Zero(), tip));
  }
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(resolved.edge_count(), 3);
  EXPECT_EQ(resolved.CycleRank(), 0);
  EXPECT_EQ(CountDegree(resolved, 3), 1);
}

TEST(ResolveIntersections, AHairpinWithLongLegsIsZippedUp) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.002, 0}, {0, 0.002, 0}});
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(resolved.edge_count(), 1);
  EXPECT_NEAR(resolved.TotalLength(), 0.1, 0.002);  // half the turn at most
}

TEST(ResolveIntersections, ACurveThatRunsBackOverItselfBecomesSimple) {
  for (const double threshold : {0.0, kThreshold}) {
    SkeletonGraph graph;
    graph.AddPolyline({{0, 0, 0}, {0.1, 0, 0}, {0.05, 0, 0}, {0.05, 0.1, 0}});
    ResolveIntersections(graph, threshold);
    EXPECT_EQ(graph.edge_count(), 3);
    EXPECT_EQ(CountDegree(graph, 3), 1);
    // The curve bends to the junction, which may lie a threshold off.
    EXPECT_NEAR(graph.TotalLength(), 0.2, std::max(1e-9, threshold));
  }
}

// Parts of the line are covered once, three and five times; where it is left, a fork is all that
// remains.
TEST(ResolveIntersections, ACurveThatRunsManyTimesOverItselfIsLaidOutInOneRound) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0},
                     {1, 0, 0},
                     {0.25, 0, 0},
                     {0.75, 0, 0},
                     {0.375, 0, 0},
                     {0.5, 0, 0},
                     {0.5, 0.5, 0}});
  const ResolutionRounds rounds = ResolveIntersections(graph, 0);
  EXPECT_EQ(rounds.joining, 1);
  EXPECT_EQ(rounds.merging + rounds.dropping, 0);
  EXPECT_EQ(graph.edge_count(), 3);
  ASSERT_EQ(CountDegree(graph, 3), 1);
  EXPECT_NEAR(graph.TotalLength(), 1.5, 1e-12);  // rounding only
}

// Cut at a millionth of its segment from a vertex, a curve stays where it is.
TEST(ResolveIntersections, AtThresholdZeroAVertexNearACrossingStays) {
  SkeletonGraph graph;
  const Vec3 corner(0, 0, 0);
  graph.AddPolyline({{-1, 0, 0}, corner, {0, 1, 0}});
  graph.AddPolyline({{-1e-6, -1, 0}, {-1e-6, 1, 0}});
  ResolveIntersections(graph, 0);
  EXPECT_EQ(graph.edge_count(), 4);
  int found = 0;
  for (const EdgeId id : graph.Edges())
    found += std::count(graph.edge(id).points.begin(), graph.edge(id).points.end(), corner);
  EXPECT_EQ(found, 1);
}

TEST(ResolveIntersections, ThousandsThroughOnePointMeetThere) {
  constexpr int kLines = 1000;
  SkeletonGraph graph;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < kLines; ++i) {
    const Vec3 tip = Vec3(normal(random), normal(random), normal(random)).normalized();
    graph.AddPolyline({-tip, tip});
  }
  const ResolutionRounds rounds = ResolveIntersections(graph, 1e-6);
  EXPECT_TRUE(Violations(graph, 1e-6).empty());
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(CountDegree(graph, 1), 2 * kLines);
  EXPECT_EQ(rounds.dropping, 0);
}

// Lines at small angles have their crossings rounded to different points.
TEST(ResolveIntersections, AtThresholdZeroAllThroughOnePointMeetWithinRounding) {
  constexpr int kLines = 60;
  SkeletonGraph graph;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < kLines; ++i) {
    const Vec3 tip(normal(random), normal(random), normal(random));
    graph.AddPolyline({-tip, tip});
  }
  ResolveIntersections(graph, 0);
  EXPECT_TRUE(Violations(graph, 0).empty());
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(CountDegree(graph, 1), 2 * kLines);
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) > 1) {
      EXPECT_LT(graph.position(node).norm(), 1e-10);
    }
  }
}

TEST(ResolveIntersections, ABadThresholdIsRejected) {
  SkeletonGraph graph;
  EXPECT_THROW(ResolveIntersections(graph, -1), Error);
  EXPECT_THROW(ResolveIntersections(graph, NAN), Error);
}

// Any soup of polylines: hundreds of tiny fragments, random walks, needles, bundles of nearly equal
// curves. It must end, be valid and idempotent.
TEST(ResolveIntersections, RandomSoupsEndValid) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&](double size) -> Vec3 {
      return size * Vec3(unit(random), unit(random), unit(random));
    };
    SkeletonGraph graph;
    const double size = seed % 3 == 0 ? 0.02 : 0.08;
    const double step = seed % 2 == 0 ? 0.001 : 0.006;
    for (int curve = 0; curve < 10 + static_cast<int>(seed) * 2; ++curve) {
      Polyline points = {vector(size)};
      Vec3 direction = vector(1).normalized();
      for (int i = 0; i < 3 + curve % 40; ++i) {
        direction = (direction + vector(0.4)).normalized();
        points.push_back(points.back() + step * direction);
      }
      graph.AddPolyline(points);
    }
    SCOPED_TRACE(seed);
    Resolved(graph);
  }
}

TEST(ResolveIntersections, NoisyCopiesOfALatticeBecomeTheLattice) {
  const SkeletonGraph truth = Lattice(3, 4, 0.05);
  SkeletonGraph graph;
  for (unsigned copy = 0; copy < 3; ++copy) {
    RigidTransform T = RigidTransform::Identity();
    T.translation() = Vec3(0.0008 * copy, -0.0005 * copy, 0.0006 * copy);
    const SkeletonGraph noisy = Perturbed(truth, T, 0.0001, copy);
    for (const EdgeId id : noisy.Edges()) graph.AddPolyline(noisy.edge(id).points);
  }
  const SkeletonGraph resolved = Resolved(graph);
  EXPECT_EQ(resolved.CycleRank(), truth.CycleRank());
  EXPECT_EQ(resolved.ComponentCount(), 1);
  EXPECT_NEAR(resolved.TotalLength(), truth.TotalLength(), 0.05 * truth.TotalLength());
}

}  // namespace
}  // namespace curvefusion
