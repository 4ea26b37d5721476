#include "graph/cycles.h"

#include <gtest/gtest.h>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

TEST(RemoveSmallCycles, OpensSmallOnesOnly) {
  SkeletonGraph graph = Lattice(2, 3, 0.05);  // cells of 200 mm
  RemoveSmallCycles(graph, 0.19);
  EXPECT_EQ(graph.CycleRank(), 2);
  RemoveSmallCycles(graph, 0.21);
  EXPECT_EQ(graph.CycleRank(), 0);
  EXPECT_EQ(graph.ComponentCount(), 1);
}

TEST(RemoveSmallCycles, RemovesTheEdgeSeenLeast) {
  SkeletonGraph graph;
  const std::vector<Vec3> corners = {{0, 0, 0}, {0.006, 0, 0}, {0, 0.006, 0}};
  for (const Vec3& p : corners) graph.AddNode(p);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    graph.AddEdge({{i, j}, {corners[i], corners[j]}, {}, {i == 1 ? 1.0 : 5.0, 5.0}});
  }
  RemoveSmallCycles(graph, 0.03);
  EXPECT_EQ(graph.Edges(), (std::vector<EdgeId>{0, 2}));
}

TEST(RemoveSmallCycles, SelfLoopsAndEmptyGraphs) {
  SkeletonGraph graph;
  RemoveSmallCycles(graph, 0.03);
  graph.AddPolyline(Ring(0.003, 20));
  graph.AddPolyline(Ring(0.03, 200));
  RemoveSmallCycles(graph, 0.03);
  EXPECT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.node_count(), 1);
}

}  // namespace
}  // namespace curvefusion
