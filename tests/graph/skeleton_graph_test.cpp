#include "graph/skeleton_graph.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

TEST(SkeletonGraph, CountsOfALattice) {
  const SkeletonGraph graph = Lattice(3, 4, 0.05);
  EXPECT_EQ(graph.edge_count(), 17);
  EXPECT_EQ(graph.CycleRank(), 6);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_NEAR(graph.TotalLength(), 17 * 0.05, 1e-12);  // rounding only
}

TEST(SkeletonGraph, SplittingAndDissolvingGiveTheCurveBack) {
  SkeletonGraph graph;
  const Polyline line = StraightLine({0, 0, 0}, {0.05, 0, 0});
  graph.AddPolyline(line);
  graph.SetCurve(0, line, std::vector<double>(line.size(), 0.002),
                 std::vector<double>(line.size(), 3));
  for (int i = 0; i < 10; ++i) graph.SplitEdge(graph.Edges().back(), 2);
  EXPECT_EQ(graph.edge_count(), 11);
  graph.DissolveDegree2Nodes();
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.node_count(), 2);
  const SkeletonEdge& edge = graph.edge(graph.Edges()[0]);
  EXPECT_EQ(edge.points, line);
  EXPECT_EQ(edge.radii.size(), line.size());
  EXPECT_EQ(edge.observations.size(), line.size());
}

TEST(SkeletonGraph, ADissolvedRingKeepsOneNode) {
  SkeletonGraph graph;
  graph.AddPolyline(Ring(0.05, 30));
  graph.SplitEdge(0, 10);
  graph.SplitEdge(graph.Edges()[1], 10);
  EXPECT_EQ(graph.node_count(), 3);
  graph.DissolveDegree2Nodes();
  EXPECT_EQ(graph.node_count(), 1);
  EXPECT_EQ(graph.CycleRank(), 1);
  EXPECT_TRUE(Violations(graph, 0.001).empty());
}

TEST(SkeletonGraph, ALoopAtAJunctionIsOneEdge) {
  SkeletonGraph graph = YShape(0.05);
  Polyline ring = Ring(0.02, 30, {-0.02, 0, 0});
  graph.MoveNode(0, ring[0]);
  const EdgeId loop = Connect(graph, 0, 0, ring);
  graph.SplitEdge(loop, 10);
  graph.SplitEdge(graph.Edges().back(), 10);
  graph.DissolveDegree2Nodes();
  EXPECT_EQ(graph.edge_count(), 4);
  EXPECT_EQ(graph.Degree(0), 5);
  EXPECT_EQ(graph.CycleRank(), 1);
}

TEST(SkeletonGraph, MergedNodesShareAllEdges) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {1, 0, 0}});
  graph.AddPolyline({{1.1, 0, 0}, {2, 0, 0}});
  graph.MergeNodes(1, 2);
  EXPECT_EQ(graph.Degree(1), 2);
  EXPECT_EQ(graph.edge(1).points.front(), Vec3(1, 0, 0));
  graph.MergeNodes(0, 1);  // the first edge shrinks to a point
  EXPECT_EQ(graph.edge_count(), 1);
}

TEST(SkeletonGraph, MergingKeepsTheTieToAThirdNodeAtTheSamePlace) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {1, 0, 0}});
  const NodeId third = graph.AddNode(Vec3::Zero());
  graph.AddEdge({{1, third}, {{1, 0, 0}, {0, 0, 0}}, {}, {}});
  graph.MergeNodes(0, 1);
  EXPECT_EQ(graph.Edges(), std::vector<EdgeId>{1});
  EXPECT_EQ(graph.OtherEnd(1, third), 0);
}

TEST(SkeletonGraph, ATakenEdgeIsNoLongerThere) {
  SkeletonGraph graph;
  const EdgeId id = graph.AddPolyline({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  const SkeletonEdge edge = graph.TakeEdge(id);
  EXPECT_EQ(edge.points.size(), 3u);
  EXPECT_FALSE(graph.HasEdge(id));
  EXPECT_EQ(graph.Degree(edge.nodes[0]), 0);
}

}  // namespace
}  // namespace curvefusion
