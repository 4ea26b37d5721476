#include "graph/parallel_edges.h"

#include <gtest/gtest.h>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

TEST(MergeParallelEdges, TwiceTheSameCurveBecomesItsWeightedMean) {
  SkeletonGraph graph;
  graph.AddNode({0, 0, 0});
  graph.AddNode({0.1, 0, 0});
  const Polyline above = {{0, 0, 0}, {0.05, 0.004, 0}, {0.1, 0, 0}};
  graph.AddEdge({{0, 1}, above, {}, {3, 3, 3}});
  graph.AddEdge({{1, 0}, {{0.1, 0, 0}, {0.05, 0, 0}, {0, 0, 0}}, {}, {1, 1, 1}});
  MergeParallelEdges(graph, 0.003);
  EXPECT_EQ(graph.edge_count(), 2);
  MergeParallelEdges(graph, 0.005);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.edge(0).points[1].y(), 0.003, 1e-12);  // three quarters of 4 mm
  EXPECT_EQ(graph.edge(0).observations[1], 4);
}

TEST(MergeParallelEdges, RingsMeetInTheRightDirection) {
  SkeletonGraph graph;
  const Polyline ring = Ring(0.05, 100);
  const NodeId node = graph.AddNode(ring[0]);
  Connect(graph, node, node, ring);
  Connect(graph, node, node, Polyline(ring.rbegin(), ring.rend()));
  MergeParallelEdges(graph, 0.001);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), Length(ring), 1e-12);  // the same points twice
}

// All vertices of the second curve lie on the first, but it runs forth and back there.
TEST(ParallelEdges, ACurveThatRunsBackOverItselfIsNotTheSame) {
  SkeletonGraph graph;
  graph.AddNode({0, 0, 0});
  graph.AddNode({0.1, 0, 0});
  Connect(graph, 0, 1, {{0, 0, 0}, {0.1, 0, 0}});
  Connect(graph, 0, 1, {{0, 0, 0}, {0.08, 0, 0}, {0.02, 0, 0}, {0.1, 0, 0}});
  EXPECT_TRUE(ParallelEdges(graph, 0.029).empty());
  EXPECT_EQ(ParallelEdges(graph, 0.031).size(), 1u);  // half of the way back
}

// At the same share of the length the curves are 19 mm apart: each has a zigzag of 20 mm where the
// other has none.
TEST(MergeParallelEdges, TheMeanStaysNearCurvesOfUnevenLength) {
  const auto zigzag = [](bool in_front) {
    Polyline points;
    for (int i = 0; i <= 100; ++i)
      points.emplace_back(0.001 * i, (i < 50) == in_front && i % 2 == 1 ? 0.001 : 0, 0);
    return points;
  };
  SkeletonGraph graph;
  graph.AddNode({0, 0, 0});
  graph.AddNode({0.1, 0, 0});
  Connect(graph, 0, 1, zigzag(true));
  Connect(graph, 0, 1, zigzag(false));
  MergeParallelEdges(graph, 0.0015);
  ASSERT_EQ(graph.edge_count(), 1);
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(graph.edge(0).points[i].x(), 0.001 * i, 0.0015) << i;
}

// A loop with a long and a short side: turned at its quarters it is nearer to itself the wrong way
// round.
TEST(MergeParallelEdges, LoopsAreTriedBothWays) {
  const Polyline loop = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.001, 0}, {0.05, 0.04, 0}, {0, 0, 0}};
  for (const bool turned : {false, true}) {
    SkeletonGraph graph;
    graph.AddNode({0, 0, 0});
    Connect(graph, 0, 0, loop);
    Connect(graph, 0, 0, turned ? Polyline(loop.rbegin(), loop.rend()) : loop);
    MergeParallelEdges(graph, 1e-9);
    EXPECT_EQ(graph.edge_count(), 1);
  }
}

}  // namespace
}  // namespace curvefusion
