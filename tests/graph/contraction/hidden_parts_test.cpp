#include "graph/contraction/hidden_parts.h"

#include <gtest/gtest.h>

#include <vector>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;
constexpr double kPixel = 0.001;

void Add(SkeletonGraph& graph, NodeId a, NodeId b, double radius) {
  const EdgeId edge =
      Connect(graph, a, b, StraightLine(graph.position(a), graph.position(b), 1e-3));
  const Polyline points = graph.edge(edge).points;
  graph.SetCurve(edge, points, std::vector<double>(points.size(), radius));
}

// A wire along x and one that comes to its middle, but parts before it does, to both sides of it:
// a triangle of which the middle of one side is the middle.
SkeletonGraph Delta(double half_side, double height, double radius = kRadius) {
  SkeletonGraph graph;
  const NodeId left = graph.AddNode({-half_side, 0, 0});
  const NodeId right = graph.AddNode({half_side, 0, 0});
  const NodeId below = graph.AddNode({0, -height, 0});
  Add(graph, left, right, radius);
  Add(graph, below, left, radius);
  Add(graph, below, right, radius);
  Add(graph, left, graph.AddNode({-0.06, 0, 0}), radius);
  Add(graph, right, graph.AddNode({0.06, 0, 0}), radius);
  Add(graph, below, graph.AddNode({0, -0.08, 0}), radius);
  return graph;
}

TEST(OpenFilledLoops, WiresThatMeetInATriangleMeetInAPoint) {
  SkeletonGraph graph = Delta(0.003, 0.010);
  EXPECT_EQ(OpenFilledLoops(graph, kPixel, {}), 1);
  EXPECT_EQ(graph.CycleRank(), 0);
  ASSERT_EQ(Junctions(graph).size(), 1U);
  EXPECT_EQ(graph.Degree(Junctions(graph)[0]), 3);
  EXPECT_LT(graph.position(Junctions(graph)[0]).norm(), 1e-3);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "opened graph"));
}

// A place inside joined to all three corners: three triangles.
TEST(OpenFilledLoops, TrianglesSideBySideAreAllOpened) {
  SkeletonGraph graph = Delta(0.003, 0.010);
  const NodeId middle = graph.AddNode({0.0005, -0.004, 0});
  for (const NodeId node : Junctions(graph)) Add(graph, node, middle, kRadius);
  EXPECT_EQ(OpenFilledLoops(graph, kPixel, {}), 3);
  EXPECT_EQ(graph.CycleRank(), 0);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "opened graph"));
}

TEST(OpenFilledLoops, OneThatImagesCouldLookThroughStays) {
  SkeletonGraph graph = Delta(0.010, 0.018);
  const SkeletonGraph before = graph;
  EXPECT_EQ(OpenFilledLoops(graph, kPixel, {}), 0);
  EXPECT_EQ(graph.edge_count(), before.edge_count());
}

// The inscribed circle has a radius of 2.2 mm: the opening is .4 mm wide.
TEST(OpenFilledLoops, AnOpeningNarrowerThanAPixelIsNone) {
  SkeletonGraph narrow = Delta(0.003, 0.010, 0.002);
  EXPECT_EQ(OpenFilledLoops(narrow, 0, {}), 0);
  EXPECT_EQ(OpenFilledLoops(narrow, kPixel, {}), 1);
}

TEST(OpenFilledLoops, LargeAndUnmeasuredLoopsStay) {
  SkeletonGraph large;
  large.AddPolyline(Ring(0.05, 100));
  EXPECT_EQ(OpenFilledLoops(large, kPixel, {}), 0);
  SkeletonGraph unmeasured = Delta(0.003, 0.010);
  for (const EdgeId edge : unmeasured.Edges())
    unmeasured.SetCurve(edge, Polyline(unmeasured.edge(edge).points));
  EXPECT_EQ(OpenFilledLoops(unmeasured, kPixel, {}), 0);
}

// Two wires that cross, which came out as two junctions some way apart.
SkeletonGraph TwoForks(double apart) {
  SkeletonGraph graph;
  const NodeId left = graph.AddNode({-apart / 2, 0, 0});
  const NodeId right = graph.AddNode({apart / 2, 0, 0});
  Add(graph, left, right, kRadius);
  Add(graph, left, graph.AddNode({-0.05, 0.04, 0}), kRadius);
  Add(graph, left, graph.AddNode({-0.05, -0.04, 0}), kRadius);
  Add(graph, right, graph.AddNode({0.05, 0.04, 0}), kRadius);
  Add(graph, right, graph.AddNode({0.05, -0.04, 0}), kRadius);
  return graph;
}

TEST(MergeHiddenJunctions, ThoseWithinADiameterAreOne) {
  SkeletonGraph graph = TwoForks(0.005);
  EXPECT_EQ(MergeHiddenJunctions(graph), 1);
  ASSERT_EQ(Junctions(graph).size(), 1U);
  EXPECT_EQ(graph.Degree(Junctions(graph)[0]), 4);
  EXPECT_LT(graph.position(Junctions(graph)[0]).norm(), 1e-9);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "merged graph"));
}

TEST(MergeHiddenJunctions, ThoseFartherApartStay) {
  SkeletonGraph graph = TwoForks(0.007);
  EXPECT_EQ(MergeHiddenJunctions(graph), 0);
  EXPECT_EQ(Junctions(graph).size(), 2U);
  SkeletonGraph empty;
  EXPECT_EQ(MergeHiddenJunctions(empty), 0);
}

}  // namespace
}  // namespace curvefusion
