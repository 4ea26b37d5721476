#include "graph/edge_curve.h"

#include <gtest/gtest.h>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

SkeletonEdge LEdge() {
  return {{0, 1}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {1, 2, 4}, {10, 20, 40}};
}

TEST(EdgeCurve, PartsShareTheirCutBitForBit) {
  const SkeletonEdge edge = LEdge();
  const std::vector<double> arcs = CumulativeLength(edge.points);
  const SkeletonEdge first = PartOfEdge(edge, arcs, 0, 1.3);
  const SkeletonEdge second = PartOfEdge(edge, arcs, 1.3, 2);
  EXPECT_EQ(first.points.back(), second.points.front());
  EXPECT_EQ(first.points.size(), 3u);
  EXPECT_EQ(second.points.size(), 2u);
  EXPECT_DOUBLE_EQ(first.radii.back(), 2.6);
  EXPECT_DOUBLE_EQ(second.observations.front(), 26);
}

TEST(EdgeCurve, ACutAtAVertexLeavesNoSplinter) {
  const SkeletonEdge edge = LEdge();
  const std::vector<double> arcs = CumulativeLength(edge.points);
  for (const double cut : {1 - 1e-9, 1.0, 1 + 1e-9}) {
    EXPECT_EQ(PartOfEdge(edge, arcs, 0, cut).points.size(), 2u);
    EXPECT_EQ(PartOfEdge(edge, arcs, cut, 2).points.size(), 2u);
  }
}

TEST(EdgeCurve, AVertexFartherThanTheLongestSplinterStays) {
  const SkeletonEdge edge = LEdge();
  const std::vector<double> arcs = CumulativeLength(edge.points);
  for (const auto& [limit, points] : {std::pair(1e-9, 2u), {0.5e-9, 3u}, {0.0, 3u}}) {
    EXPECT_EQ(PartOfEdge(edge, arcs, 0, 1 + 0.75e-9, limit).points.size(), points);
    EXPECT_EQ(PartOfEdge(edge, arcs, 1 - 0.75e-9, 2, limit).points.size(), points);
  }
  // A cut at a vertex is the vertex.
  EXPECT_EQ(PartOfEdge(edge, arcs, 0, 1, 0).points.size(), 2u);
  EXPECT_EQ(PartOfEdge(edge, arcs, 1, 2, 0).points.size(), 2u);
}

TEST(EdgeCurve, ResamplingKeepsEndsAndInterpolates) {
  const SkeletonEdge edge = Resampled(LEdge(), 0.1);
  ASSERT_EQ(edge.points.size(), 21u);
  EXPECT_EQ(edge.points.front(), Vec3(0, 0, 0));
  EXPECT_EQ(edge.points.back(), Vec3(1, 1, 0));
  EXPECT_NEAR(edge.radii[15], 3, 1e-12);  // rounding of the arc length only
}

TEST(EdgeCurve, RepeatedPointsGo) {
  SkeletonEdge edge{{0, 1}, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {1, 2, 3, 4}, {}};
  RemoveRepeatedPoints(edge);
  EXPECT_EQ(edge.points, (Polyline{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(edge.radii, (std::vector<double>{1, 4}));
}

TEST(EdgeCurve, AnEdgeThatIsAPointDisappears) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0, 0, 0}});
  graph.AddPolyline({{1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  RemoveZeroLengthSegments(graph);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.edge(1).points.size(), 3u);
}

TEST(EdgeCurve, WhatHangsTogetherByAnEdgeThatIsAPointStaysTogether) {
  SkeletonGraph graph;
  for (const double x : {-1.0, 0.0, 0.0, 1.0}) graph.AddNode({x, 0, 0});
  for (int i = 0; i < 3; ++i)
    graph.AddEdge({{i, i + 1}, {graph.position(i), graph.position(i + 1)}, {}, {}});
  RemoveZeroLengthSegments(graph);
  EXPECT_EQ(graph.Nodes(), (std::vector<NodeId>{0, 1, 3}));
  EXPECT_EQ(graph.Edges(), (std::vector<EdgeId>{0, 2}));
  EXPECT_EQ(graph.Degree(1), 2);
}

TEST(EdgeCurve, ABendEndsAtAPointOfItsOwnOnALongSegment) {
  SkeletonGraph graph;
  const NodeId node = graph.AddNode(Vec3::Zero());
  const NodeId far = graph.AddNode({0.1, 0, 0});
  const NodeId near = graph.AddNode({0, 0.03, 0});
  // One begins at the node, the other ends there.
  graph.AddEdge({{node, far}, {{0, 0, 0}, {0.1, 0, 0}}, {1, 2}, {}});
  graph.AddEdge({{near, node}, {{0, 0.03, 0}, {0, 0, 0}}, {}, {}});
  MoveNodeWithBends(graph, node, {0, 0, 0.004}, 0.02);
  ASSERT_EQ(graph.edge(0).points.size(), 3u);
  EXPECT_EQ(graph.edge(0).points[0], Vec3(0, 0, 0.004));
  EXPECT_NEAR((graph.edge(0).points[1] - Vec3(0.02, 0, 0)).norm(), 0, 1e-17);  // rounding
  EXPECT_NEAR(graph.edge(0).radii[1], 1.2, 1e-15);
  EXPECT_EQ(graph.edge(1).points, (Polyline{{0, 0.03, 0}, {0, 0, 0.004}}));  // too short for one
}

TEST(EdgeCurve, ADisplacementFadesOut) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  MoveNodeSmoothly(graph, 0, {0, 0.004, 0}, 0.02);
  const Polyline& points = graph.edge(0).points;
  EXPECT_EQ(points[0], Vec3(0, 0.004, 0));
  EXPECT_NEAR(points[10].y(), 0.002, 1e-15);
  EXPECT_EQ(points[20].y(), 0);
  EXPECT_EQ(points.back(), Vec3(0.1, 0, 0));
}

}  // namespace
}  // namespace curvefusion
