#include "graph/contraction/free_ends.h"

#include <gtest/gtest.h>

#include <cmath>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

TEST(CloseFreeEnds, BridgesAGapInAWire) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.05, 0, 0}));
  graph.AddPolyline(StraightLine({0.1, 0, 0}, {0.058, 0, 0}));
  CloseFreeEnds(graph, {});
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.1, 1e-12);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "closed graph"));
}

TEST(CloseFreeEnds, ClosesARingWithAGap) {
  SkeletonGraph graph;
  Polyline ring = Ring(0.03, 188);  // 1 mm steps
  ring.resize(ring.size() - 9);
  graph.AddPolyline(ring);
  CloseFreeEnds(graph, {});
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.CycleRank(), 1);
  EXPECT_EQ(CountDegree(graph, 1), 0);
}

TEST(CloseFreeEnds, JoinsAnEndToTheCurveAhead) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}));
  graph.AddPolyline(StraightLine({0.01, 0.06, 0}, {0.01, 0.009, 0}));
  CloseFreeEnds(graph, {});
  EXPECT_EQ(graph.edge_count(), 3);
  EXPECT_EQ(CountDegree(graph, 3), 1);
  EXPECT_EQ(graph.ComponentCount(), 1);
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) != 3) continue;
    // The vertex ahead, of one each mm.
    EXPECT_LT((graph.position(node) - Vec3(0.01, 0, 0)).norm(), 1e-3);
  }
}

TEST(CloseFreeEnds, JoinsSeveralEndsToOneCurve) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.1, 0, 0}, {0.1, 0, 0}));
  for (const double x : {-0.06, -0.02, 0.03, 0.07}) {
    graph.AddPolyline(StraightLine({x, 0.06, 0}, {x, 0.008, 0}));
  }
  CloseFreeEnds(graph, {});
  EXPECT_EQ(CountDegree(graph, 3), 4);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "closed graph"));
}

TEST(CloseFreeEnds, LeavesEndsThatFaceNothing) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  graph.AddPolyline(StraightLine({0, 0.015, 0}, {0.1, 0.015, 0}));  // a parallel wire
  graph.AddPolyline(StraightLine({0.17, 0, 0}, {0.2, 0, 0}));       // 70 mm ahead
  CloseFreeEnds(graph, {});
  EXPECT_EQ(graph.edge_count(), 3);
  EXPECT_EQ(graph.ComponentCount(), 3);
}

TEST(CloseFreeEnds, BridgesABendAlongItsCurve) {
  // A wire that turns by 60 degrees about a radius of 40 mm, of which a stretch of 30 degrees is
  // missing: 21 mm.
  const auto at = [](double degrees) {
    const double angle = degrees * M_PI / 180;
    return Vec3(0.04 * std::sin(angle), 0.04 * std::cos(angle), 0);
  };
  SkeletonGraph graph;
  Polyline before = StraightLine({-0.05, 0.04, 0}, {0, 0.04, 0});
  for (double d = 1.5; d < 16; d += 1.5) before.push_back(at(d));
  Polyline after;
  for (double d = 45; d < 90; d += 1.5) after.push_back(at(d));
  graph.AddPolyline(before);
  graph.AddPolyline(after);
  CloseFreeEnds(graph, {});
  ASSERT_EQ(graph.edge_count(), 1);
  // The middle of a straight bridge would lie 1.4 mm inside; directions are means over 15 mm.
  double nearest = 1;
  for (const Vec3& p : graph.edge(graph.Edges()[0]).points) {
    nearest = std::min(nearest, (p - at(30)).norm());
  }
  EXPECT_LT(nearest, 1.2e-3);
}

TEST(CloseFreeEnds, ReachesFartherWherePointsWereSeen) {
  const auto make = [] {
    SkeletonGraph graph;
    graph.AddPolyline(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}));
    graph.AddPolyline(StraightLine({0.01, 0.12, 0}, {0.01, 0.035, 0}));
    return graph;
  };
  SkeletonGraph without = make();
  CloseFreeEnds(without, {});
  EXPECT_EQ(without.ComponentCount(), 2);
  ObservedPoints points;
  for (double y = 0.002; y < 0.035; y += 0.004) points.Add({0.011, y, 0.001}, Vec3::Zero(), 1);
  SkeletonGraph with = make();
  CloseFreeEnds(with, {}, points);
  EXPECT_EQ(with.ComponentCount(), 1);
}

TEST(CloseFreeEnds, FacingEndsDoNotRunIntoEachOthersSides) {
  SkeletonGraph graph;  // overlapping by 5 mm, 2 mm apart
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.055, 0, 0}));
  graph.AddPolyline(StraightLine({0.1, 0.002, 0}, {0.05, 0.002, 0}));
  CloseFreeEnds(graph, {});
  EXPECT_EQ(CountDegree(graph, 3), 0);
}

TEST(CloseFreeEnds, ShortPiecesDoNotReachFar) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}));
  graph.AddPolyline(StraightLine({0.01, 0.03, 0}, {0.01, 0.02, 0}));
  CloseFreeEnds(graph, {});
  EXPECT_EQ(graph.ComponentCount(), 2);
}

TEST(CloseFreeEnds, MakesNoLoopShorterThanTheLeast) {
  SkeletonGraph graph;  // a hook of 8 mm that bends over its own wire
  const NodeId root = graph.AddNode({0, 0, 0});
  Connect(graph, root, graph.AddNode({0.1, 0, 0}), StraightLine({0, 0, 0}, {0.1, 0, 0}));
  Connect(graph, root, graph.AddNode({-0.1, 0, 0}), StraightLine({0, 0, 0}, {-0.1, 0, 0}));
  const Polyline hook{{0, 0, 0}, {0.002, 0.004, 0}, {0.004, 0.0045, 0}, {0.005, 0.003, 0}};
  Connect(graph, root, graph.AddNode(hook.back()), hook);
  CloseFreeEnds(graph, {});
  EXPECT_EQ(graph.CycleRank(), 0);
}

// Both ends reach for each other across a wire between them: a crossing, not a wire that passes.
TEST(CloseFreeEnds, DoesNotReachAcrossACurve) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.06, 0, 0}, {-0.008, 0, 0}));
  graph.AddPolyline(StraightLine({0.06, 0, 0}, {0.008, 0, 0}));
  graph.AddPolyline(StraightLine({0, -0.06, 0}, {0, 0.06, 0}));
  CloseFreeEnds(graph, {});
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(CountDegree(graph, 4), 1);
}

// A ring of which one side of a crossing is missing.
TEST(CloseFreeEnds, ReachesAJunctionThatABranchEndsAt) {
  SkeletonGraph graph;
  const NodeId crossing = graph.AddNode(Vec3::Zero());
  for (const Vec3& far : {Vec3(0, 0.06, 0), Vec3(0, -0.06, 0), Vec3(-0.06, 0, 0)}) {
    Connect(graph, crossing, graph.AddNode(far), StraightLine({0, 0, 0}, far));
  }
  graph.AddPolyline(StraightLine({0.1, 0, 0}, {0.032, 0, 0}));
  CloseFreeEnds(graph, {});
  EXPECT_EQ(graph.Degree(crossing), 4);
  EXPECT_EQ(graph.ComponentCount(), 1);
}

// A short piece on its own would not reach so far; the long wire that it continues vouches for it.
TEST(CloseFreeEnds, LongWiresReachForShortPiecesThatContinueThem) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.1, 0, 0}, {0, 0, 0}));
  graph.AddPolyline(StraightLine({0.04, 0, 0}, {0.054, 0, 0}));
  CloseFreeEnds(graph, {});
  EXPECT_EQ(graph.ComponentCount(), 1);
}

TEST(CloseFreeEnds, EmptyStaysEmpty) {
  SkeletonGraph graph;
  CloseFreeEnds(graph, {});
  EXPECT_TRUE(graph.empty());
}

}  // namespace
}  // namespace curvefusion
