#include "fusion/adjustment/curve_vertices.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

constexpr double kStep = 0.003;
constexpr double kCorner = 1.0;

// A straight wire of 60 mm with a second one welded to its middle.
SkeletonGraph Tee() {
  SkeletonGraph skeleton;
  const NodeId left = skeleton.AddNode({-0.03, 0, 0});
  const NodeId middle = skeleton.AddNode({0, 0, 0});
  const NodeId right = skeleton.AddNode({0.03, 0, 0});
  const NodeId top = skeleton.AddNode({0, 0.03, 0});
  skeleton.AddEdge({{left, middle}, {{-0.03, 0, 0}, {0, 0, 0}}, {0.002, 0.002}, {}});
  skeleton.AddEdge({{middle, right}, {{0, 0, 0}, {0.03, 0, 0}}, {0.002, 0.002}, {}});
  skeleton.AddEdge({{middle, top}, {{0, 0, 0}, {0, 0.03, 0}}, {0.003, 0.003}, {}});
  return skeleton;
}

TEST(SampleVerticesTest, EdgesShareTheVertexOfTheirNode) {
  const CurveVertices vertices = SampleVertices(Tee(), kStep, kCorner);
  // 4 nodes and 9 inner points on each of three edges of 30 mm
  EXPECT_EQ(vertices.positions.size(), 4u + 3 * 9);
  ASSERT_EQ(vertices.edges.size(), 3u);
  EXPECT_EQ(vertices.edges[0].size(), 11u);
  EXPECT_EQ(vertices.edges[0].back(), vertices.edges[1].front());
  EXPECT_EQ(vertices.edges[0].back(), vertices.edges[2].front());
  EXPECT_EQ(vertices.radii[vertices.edges[0][5]], 0.002);
  EXPECT_EQ(vertices.radii[vertices.edges[2].front()], 0.003);  // the thickest there
}

TEST(SampleVerticesTest, OnlyTheStraightWireGoesThroughItsJunction) {
  const CurveVertices vertices = SampleVertices(Tee(), kStep, kCorner);
  const int junction = vertices.edges[0].back();
  int through = 0;
  for (const auto& row : vertices.rows) {
    if (row[1] != junction) continue;
    ++through;
    EXPECT_NEAR(vertices.positions[row[0]].y(), 0, 1e-12);  // both on the straight wire, exactly
    EXPECT_NEAR(vertices.positions[row[2]].y(), 0, 1e-12);
  }
  EXPECT_EQ(through, 1);
  EXPECT_EQ(vertices.rows.size(), 3u * 9 + 1);
}

TEST(SampleVerticesTest, CornersAreNotSmoothed) {
  SkeletonGraph skeleton;
  skeleton.AddPolyline({{0, 0, 0}, {0.03, 0, 0}, {0.03, 0.03, 0}});
  const CurveVertices vertices = SampleVertices(skeleton, kStep, kCorner);
  // 20 steps have 19 rows, of which the one around the right angle is missing
  EXPECT_EQ(vertices.rows.size(), 18u);
}

TEST(SampleVerticesTest, AClosedCurveIsSmoothAllAround) {
  SkeletonGraph skeleton;
  Polyline circle;
  for (int i = 0; i < 60; ++i) {
    circle.emplace_back(0.05 * std::cos(i * M_PI / 30), 0.05 * std::sin(i * M_PI / 30), 0);
  }
  circle.push_back(circle.front());
  skeleton.AddPolyline(circle);
  const CurveVertices vertices = SampleVertices(skeleton, kStep, kCorner);
  EXPECT_EQ(vertices.rows.size(), vertices.positions.size());
}

TEST(SampleVerticesTest, NothingGivesNothing) {
  EXPECT_TRUE(SampleVertices({}, kStep, kCorner).positions.empty());
}

TEST(WithVerticesTest, MovesNodesAndCurvesAndKeepsRadii) {
  CurveVertices vertices = SampleVertices(Tee(), kStep, kCorner);
  const Vec3 shift(0.001, 0.002, 0.003);
  for (Vec3& position : vertices.positions) position += shift;
  const SkeletonGraph moved = WithVertices(Tee(), vertices, kStep);
  ASSERT_EQ(moved.edge_count(), 3);
  for (const EdgeId id : moved.Edges()) {
    const SkeletonEdge& edge = moved.edge(id);
    EXPECT_EQ(edge.points.front(), moved.position(edge.nodes[0]));
    EXPECT_EQ(edge.points.back(), moved.position(edge.nodes[1]));
    EXPECT_EQ(edge.radii.size(), edge.points.size());
  }
  EXPECT_TRUE(moved.position(moved.Nodes()[1]).isApprox(shift, 1e-12));  // rounding
}

}  // namespace
}  // namespace curvefusion
