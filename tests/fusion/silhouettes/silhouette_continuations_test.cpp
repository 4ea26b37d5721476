#include "fusion/silhouettes/silhouette_continuations.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kMinShare = 0.9;
constexpr double kHalfBar = 0.05;
constexpr double kRows[] = {-0.04, 0, 0.04};

// Three parallel bars and the beginning of a wire across them, up to the first.
SkeletonGraph BarsWithStub() {
  SkeletonGraph graph;
  const Vec3 first(0, kRows[0], 0);
  const NodeId node = graph.AddNode(first);
  for (const double side : {-kHalfBar, kHalfBar}) {
    const Vec3 end(side, kRows[0], 0);
    AddTestEdge(graph, graph.AddNode(end), node, TestLine(end, first));
  }
  const Vec3 begin(0, -0.08, 0);
  AddTestEdge(graph, graph.AddNode(begin), node, TestLine(begin, first));
  for (const double y : {kRows[1], kRows[2]})
    AddTestEdge(graph, TestLine({-kHalfBar, y, 0}, {kHalfBar, y, 0}));
  return graph;
}

// The bars, and the wire as far as a place.
std::vector<Polyline> Wires(double end) {
  std::vector<Polyline> wires{TestLine({0, -0.08, 0}, {0, end, 0})};
  for (const double y : kRows) wires.push_back(TestLine({-kHalfBar, y, 0}, {kHalfBar, y, 0}));
  return wires;
}

TEST(SilhouetteContinuations, GoFromWireToWire) {
  const SilhouetteScan scan(Wires(kRows[2]));
  SkeletonGraph graph = BarsWithStub();
  EXPECT_EQ(ContinueWires(scan.Silhouettes(), kMinShare, graph), 2);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.CycleRank(), 0);
  // Places to reach lie every 1.5 mm.
  EXPECT_NEAR(graph.TotalLength(), 6 * kHalfBar + 0.12, 0.001);
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(SilhouetteContinuations, EndWhereTheWireEnds) {
  const SilhouetteScan scan(Wires(kRows[1]));
  SkeletonGraph graph = BarsWithStub();
  EXPECT_EQ(ContinueWires(scan.Silhouettes(), kMinShare, graph), 1);
  EXPECT_EQ(graph.ComponentCount(), 2);
}

TEST(SilhouetteContinuations, AreNoneWhereImagesLookBetween) {
  const SilhouetteScan scan(Wires(kRows[0]));
  SkeletonGraph graph = BarsWithStub();
  EXPECT_EQ(ContinueWires(scan.Silhouettes(), kMinShare, graph), 0);
  EXPECT_EQ(graph.edge_count(), 5);
}

// All images show the bars as one sheet: the stub may be a piece of that.
TEST(SilhouetteContinuations, AreNoneInASheet) {
  const SilhouetteScan scan(
      Wires(kRows[2]),
      {{{-0.04, kRows[0], 0}, {0.04, kRows[0], 0}, {0.04, kRows[2], 0}, {-0.04, kRows[2], 0}}});
  SkeletonGraph graph = BarsWithStub();
  EXPECT_EQ(ContinueWires(scan.Silhouettes(), kMinShare, graph), 0);
}

// The stub's end has been drawn sideways.
TEST(SilhouetteContinuations, TurnToWhereTheWireIs) {
  const SilhouetteScan scan(Wires(kRows[1]));
  SkeletonGraph graph = BarsWithStub();
  const EdgeId stub = graph.Edges()[2];
  Polyline bent = graph.edge(stub).points;
  for (size_t i = 0; i + 1 < bent.size(); ++i) bent[i].x() = 0.12 * (bent[i].y() - kRows[0]);
  const NodeId crossing = graph.edge(stub).nodes[1];
  graph.RemoveEdge(stub);
  AddTestEdge(graph, graph.AddNode(bent.front()), crossing, bent);
  EXPECT_EQ(ContinueWires(scan.Silhouettes(), kMinShare, graph), 1);
  int reached = 0;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) != 3 || graph.position(node).y() != kRows[1]) continue;
    ++reached;
    EXPECT_NEAR(graph.position(node).x(), 0, 0.003);  // paths are tried every 3 mm
  }
  EXPECT_EQ(reached, 1);
}

}  // namespace
}  // namespace curvefusion
