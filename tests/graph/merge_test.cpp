#include "graph/merge.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

// Two junctions `link` apart on the x axis with two arms of 50 mm each.
SkeletonGraph HShape(double link) {
  SkeletonGraph graph;
  graph.AddNode({0, 0, 0});
  graph.AddNode({link, 0, 0});
  Connect(graph, 0, 1, StraightLine({0, 0, 0}, {link, 0, 0}));
  for (const NodeId junction : {0, 1}) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 foot = graph.position(junction);
      const Vec3 tip = foot + Vec3(junction == 0 ? -0.03 : 0.03, 0.04 * side, 0);
      Connect(graph, junction, graph.AddNode(tip), StraightLine(foot, tip));
    }
  }
  return graph;
}

TEST(RemoveShortEdges, SpursGoLinksShrinkCurvesStayWhole) {
  SkeletonGraph graph = HShape(0.0015);
  const NodeId junction = graph.SplitEdge(graph.Edges()[1], 20);
  const Vec3 tip = graph.position(junction) + Vec3(0, 0, 0.0015);
  Connect(graph, junction, graph.AddNode(tip), {graph.position(junction), tip});
  graph.AddPolyline(StraightLine({1, 0, 0}, {1.001, 0, 0}));
  RemoveShortEdges(graph, 0.002);
  EXPECT_EQ(graph.edge_count(), 4);
  EXPECT_EQ(CountDegree(graph, 4), 1);
  EXPECT_EQ(graph.node_count(), 5);
  EXPECT_TRUE(Violations(graph, 0.001).empty());
}

TEST(RemoveShortEdges, ACurveOfShortPiecesIsNotShort) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.05, 0, 0}));
  for (int i = 0; i < 20; ++i) graph.SplitEdge(graph.Edges().back(), 1);
  RemoveShortEdges(graph, 0.002);
  EXPECT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.05, 1e-12);
}

TEST(RemoveShortEdges, NothingAndOnlyFragmentsAreFine) {
  SkeletonGraph graph;
  RemoveShortEdges(graph, 0.002);
  for (int i = 0; i < 50; ++i) graph.AddPolyline({{0.01 * i, 0, 0}, {0.01 * i, 0.001, 0}});
  RemoveShortEdges(graph, 0.002);
  EXPECT_TRUE(graph.empty());
  EXPECT_EQ(graph.node_count(), 0);
}

TEST(PruneSpurs, OnlyDanglingBranchesAtJunctionsGo) {
  SkeletonGraph graph = YShape(0.05);
  const NodeId junction = graph.SplitEdge(0, 25);
  const Vec3 tip = graph.position(junction) + Vec3(0, 0, 0.008);
  Connect(graph, junction, graph.AddNode(tip), {graph.position(junction), tip});
  graph.AddPolyline(StraightLine({1, 0, 0}, {1.005, 0, 0}));
  PruneSpurs(graph, 0.01);
  EXPECT_EQ(graph.edge_count(), 4);
  EXPECT_EQ(CountDegree(graph, 3), 1);
}

TEST(PruneSpurs, RemovesShortOnesAndJoinsTheRest) {
  SkeletonGraph graph;
  const NodeId middle = graph.AddNode({0, 0, 0});
  for (const Vec3& tip : {Vec3(0.05, 0, 0), Vec3(-0.05, 0, 0), Vec3(0, 0.01, 0)}) {
    Connect(graph, middle, graph.AddNode(tip), StraightLine({0, 0, 0}, tip));
  }
  PruneSpurs(graph, 0.012);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.1, 1e-12);
  EXPECT_EQ(graph.node_count(), 2);
}

TEST(PruneSpurs, OfTwoThatForkTheLongerGoesOn) {
  SkeletonGraph graph;
  const NodeId fork = graph.AddNode({0, 0, 0});
  for (const Vec3& tip : {Vec3(0.05, 0, 0), Vec3(-0.008, 0.002, 0), Vec3(-0.004, -0.002, 0)}) {
    Connect(graph, fork, graph.AddNode(tip), StraightLine({0, 0, 0}, tip));
  }
  PruneSpurs(graph, 0.012);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.05 + std::hypot(0.008, 0.002), 1e-12);
}

TEST(PruneSpurs, KeepsLoneCurvesAndClosedOnes) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.005, 0, 0}));
  graph.AddPolyline(Ring(0.03, 100));
  PruneSpurs(graph, 0.012);
  EXPECT_EQ(graph.edge_count(), 2);
}

TEST(RemoveSmallLoops, OnlySmallOnesGo) {
  SkeletonGraph graph;
  graph.AddPolyline(Ring(0.001, 20));
  graph.AddPolyline(Ring(0.01, 20));
  RemoveSmallLoops(graph, 0.01);
  EXPECT_EQ(graph.edge_count(), 1);
}

}  // namespace
}  // namespace curvefusion
