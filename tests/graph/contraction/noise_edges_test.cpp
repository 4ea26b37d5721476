#include "graph/contraction/noise_edges.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/graph/graph_fixtures.h"
#include "tests/graph/noisy_wires.h"

namespace curvefusion {
namespace {

const Polyline kLeft = StraightLine({0, 0, 0}, {0.1, 0, 0});
const Polyline kRight = StraightLine({0, 0.022, 0}, {0.1, 0.022, 0});
const Polyline kRung = StraightLine({0.05, 0, 0}, {0.05, 0.022, 0});

// Two wires with an edge from the middle of one to that of the other.
SkeletonGraph WiresWithRung() {
  SkeletonGraph graph;
  const NodeId below = graph.SplitEdge(graph.AddPolyline(kLeft), kLeft.size() / 2);
  const NodeId above = graph.SplitEdge(graph.AddPolyline(kRight), kRight.size() / 2);
  Polyline rung = kRung;
  rung.front() = graph.position(below);
  rung.back() = graph.position(above);
  graph.AddEdge({{below, above}, rung, {}, {}});
  return graph;
}

ObservedPoints Weighed(const std::vector<Polyline>& wires, float weight) {
  ObservedPoints points = NoisyWires(wires);
  for (float& count : points.counts) count *= weight;
  return points;
}

// The camera looks along the plane of the wires, so that noise lies along its rays.
TEST(DropNoiseEdges, DropsWhatRunsAlongNoiseBetweenWires) {
  ObservedPoints points = Weighed({kLeft, kRight}, 30);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(0, 0.1), across(0, 0.022), height(-0.004, 0.004);
  for (int i = 0; i < 4000; ++i)
    points.Add({along(random), across(random), height(random)}, Vec3::UnitX(), 1);
  SkeletonGraph graph = WiresWithRung();
  DropNoiseEdges(graph, points, {});
  EXPECT_EQ(graph.edge_count(), 2);  // each wire one edge again
  EXPECT_EQ(graph.ComponentCount(), 2);
}

TEST(DropNoiseEdges, KeepsAWeakWireWithClearSides) {
  ObservedPoints points = Weighed({kLeft, kRight}, 30);
  Append(points, Weighed({kRung}, 6));
  SkeletonGraph graph = WiresWithRung();
  DropNoiseEdges(graph, points, {});
  EXPECT_EQ(graph.edge_count(), 5);
}

TEST(DropNoiseEdges, KeepsWiresSideBySide) {
  std::vector<Polyline> wires;
  SkeletonGraph graph;
  for (int i = 0; i < 5; ++i) {
    wires.push_back(StraightLine({0, 0.008 * i, 0}, {0.1, 0.008 * i, 0}));
    graph.AddPolyline(wires.back());
  }
  DropNoiseEdges(graph, NoisyWires(wires), {});
  EXPECT_EQ(graph.edge_count(), 5);
}

TEST(DropNoiseEdges, NothingGivesNothing) {
  SkeletonGraph graph;
  DropNoiseEdges(graph, NoisyWires({kLeft}), {});
  EXPECT_TRUE(graph.empty());
  graph.AddPolyline(kLeft);
  DropNoiseEdges(graph, {}, {});
  EXPECT_EQ(graph.edge_count(), 1);
}

}  // namespace
}  // namespace curvefusion
