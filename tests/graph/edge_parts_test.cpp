#include "graph/edge_parts.h"

#include <gtest/gtest.h>

#include "graph/validate.h"

namespace curvefusion {
namespace {

// Eleven points 10 mm apart, of radii 1 to 11 mm.
SkeletonGraph Straight() {
  SkeletonGraph graph;
  SkeletonEdge edge;
  for (int i = 0; i <= 10; ++i) {
    edge.points.emplace_back(0.01 * i, 0, 0);
    edge.radii.push_back(0.001 * (i + 1));
  }
  edge.nodes = {graph.AddNode(edge.points.front()), graph.AddNode(edge.points.back())};
  graph.AddEdge(edge);
  return graph;
}

TEST(KeepParts, LeavesLongPartsWithTheirRadii) {
  SkeletonGraph graph = Straight();
  const std::vector<EdgePart> parts = {{0, 3}, {5, 6}, {8, 8}, {9, 10}};
  KeepParts(graph.Edges()[0], parts, 0.005, graph);
  ASSERT_EQ(graph.edge_count(), 3);
  EXPECT_TRUE(Faults(graph).empty());
  const SkeletonEdge& first = graph.edge(graph.Edges()[0]);
  EXPECT_EQ(first.nodes[0], 0);
  EXPECT_EQ(first.points.back(), Vec3(0.03, 0, 0));
  const SkeletonEdge& middle = graph.edge(graph.Edges()[1]);
  EXPECT_EQ(middle.radii, (std::vector<double>{0.001 * 6, 0.001 * 7}));
  EXPECT_EQ(graph.Degree(middle.nodes[0]), 1);
  EXPECT_EQ(graph.edge(graph.Edges()[2]).nodes[1], 1);
}

TEST(KeepParts, DropsShortParts) {
  SkeletonGraph graph = Straight();
  KeepParts(graph.Edges()[0], {{0, 3}, {5, 6}}, 0.02, graph);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_DOUBLE_EQ(Length(graph.edge(graph.Edges()[0]).points), 0.03);
  EXPECT_EQ(graph.Degree(1), 0);
}

TEST(KeepParts, OfNothingRemovesTheEdge) {
  SkeletonGraph graph = Straight();
  KeepParts(graph.Edges()[0], {}, 0, graph);
  EXPECT_TRUE(graph.empty());
}

}  // namespace
}  // namespace curvefusion
