#pragma once

#include <gtest/gtest.h>

#include <random>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Five nodes and eight edges among them (self-loops and parallel edges, too) of four points each,
/// with coordinates of very different size; some with radii, some with observations.
inline SkeletonGraph RandomGraph(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&]() -> Vec3 {
    return {coordinate(random), coordinate(random) * 1e-9, coordinate(random) * 1e5};
  };
  SkeletonGraph graph;
  for (int i = 0; i < 5; ++i) graph.AddNode(point());
  for (int i = 0; i < 8; ++i) {
    const NodeId a = static_cast<NodeId>(random() % 5);
    const NodeId b = static_cast<NodeId>(random() % 5);
    SkeletonEdge edge{{a, b}, {graph.position(a), point(), point(), graph.position(b)}, {}, {}};
    if (i % 2 == 0) edge.radii = {0.1, 0.2, 0.3 + i, 1.0 / 3};
    if (i % 4 == 1) edge.radii = {0.1, 0.1, 0.1, 0.1};
    if (i % 3 == 0) edge.observations = {1, 2, 0.1, 1e-300};
    graph.AddEdge(edge);
  }
  return graph;
}

/// Expects the same nodes and edges in the same order, bit for bit.
inline void ExpectSameGraph(const SkeletonGraph& a, const SkeletonGraph& b) {
  ASSERT_EQ(a.node_count(), b.node_count());
  ASSERT_EQ(a.edge_count(), b.edge_count());
  for (int i = 0; i < a.node_count(); ++i)
    EXPECT_EQ(a.position(a.Nodes()[i]), b.position(b.Nodes()[i]));
  for (int i = 0; i < a.edge_count(); ++i) {
    const SkeletonEdge& edge_a = a.edge(a.Edges()[i]);
    const SkeletonEdge& edge_b = b.edge(b.Edges()[i]);
    EXPECT_EQ(edge_a.points, edge_b.points);
    EXPECT_EQ(edge_a.radii, edge_b.radii);
    EXPECT_EQ(edge_a.observations, edge_b.observations);
  }
}

}  // namespace curvefusion
