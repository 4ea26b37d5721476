#include "graph/connected_parts.h"

#include <gtest/gtest.h>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

TEST(DropShortLoops, DropsLoopsAtJunctionsAndDoubleEdges) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({0, 0, 0});
  const NodeId b = graph.AddNode({0.012, 0, 0});
  Connect(graph, a, graph.AddNode({-0.05, 0, 0}), StraightLine({0, 0, 0}, {-0.05, 0, 0}));
  Connect(graph, a, graph.AddNode({0, 0.05, 0}), StraightLine({0, 0, 0}, {0, 0.05, 0}));
  Connect(graph, a, b, {{0, 0, 0}, {0.006, 0.004, 0}, {0.012, 0, 0}});
  Connect(graph, a, b, StraightLine({0, 0, 0}, {0.012, 0, 0}));
  Connect(graph, b, graph.AddNode({0.05, 0, 0}), StraightLine({0.012, 0, 0}, {0.05, 0, 0}));
  Connect(graph, a, a, {{0, 0, 0}, {0, -0.008, 0}, {0.005, -0.008, 0}, {0, 0, 0}});
  ASSERT_EQ(graph.CycleRank(), 2);
  DropShortLoops(graph, 0.035);
  EXPECT_EQ(graph.CycleRank(), 0);
  EXPECT_NEAR(graph.TotalLength(), 0.15, 1e-12);  // three straight arms of 50 mm
}

TEST(DropShortLoops, KeepsLongLoopsAndClosedCurves) {
  SkeletonGraph graph;
  graph.AddPolyline(Ring(0.004, 50));  // 25 mm round, no junction
  const NodeId a = graph.AddNode({0.1, 0, 0});
  const NodeId b = graph.AddNode({0.12, 0, 0});
  Connect(graph, a, b, StraightLine({0.1, 0, 0}, {0.12, 0, 0}));
  Connect(graph, a, b, {{0.1, 0, 0}, {0.11, 0.01, 0}, {0.12, 0, 0}});
  DropShortLoops(graph, 0.035);
  EXPECT_EQ(graph.CycleRank(), 2);
}

TEST(DropSmallComponents, CountsTheWholeComponent) {
  SkeletonGraph graph = YShape(0.01);  // 30 mm in three edges
  graph.AddPolyline(StraightLine({1, 0, 0}, {1.02, 0, 0}));
  DropSmallComponents(graph, 0.025);
  EXPECT_EQ(graph.edge_count(), 3);
  EXPECT_EQ(graph.node_count(), 4);
  DropSmallComponents(graph, 0.031);
  EXPECT_EQ(graph.edge_count(), 0);
  EXPECT_EQ(graph.node_count(), 0);
}

}  // namespace
}  // namespace curvefusion
