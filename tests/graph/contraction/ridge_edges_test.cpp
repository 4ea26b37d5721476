#include "graph/contraction/ridge_edges.h"

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

ObservedPoints Strong(const std::vector<Polyline>& wires) {
  ObservedPoints points = NoisyWires(wires);
  for (float& count : points.counts) count *= 30;
  return points;
}

TEST(DropNoiseEdges, DropsWhatRunsAlongNoiseBetweenWires) {
  ObservedPoints points = Strong({kLeft, kRight});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(0, 0.1), across(0, 0.022), height(-0.004, 0.004);
  for (int i = 0; i < 4000; ++i) {
    points.Add({along(random), across(random), height(random)}, Vec3::Zero(), 1);
  }
  SkeletonGraph graph = WiresWithRung();
  DropNoiseEdges(graph, points, {});
  EXPECT_EQ(graph.edge_count(), 2);  // each wire one edge again
  EXPECT_EQ(graph.ComponentCount(), 2);
}

TEST(DropNoiseEdges, KeepsAWeakWireWithClearSides) {
  ObservedPoints points = Strong({kLeft, kRight});
  ObservedPoints weak = NoisyWires({kRung});
  for (float& count : weak.counts) count *= 6;  // a fifth of the wires
  Append(points, weak);
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

// Two wires that part at 20 degrees, with a weak link between them 30 mm from the fork.
TEST(DropNoiseEdges, OpensTheTriangleInAFork) {
  SkeletonGraph graph;
  const NodeId fork = graph.AddNode(Vec3::Zero());
  const NodeId on_one = graph.AddNode({0.025, 0, 0});
  const NodeId on_other = graph.AddNode({0.0235, 0.00855, 0});
  const Vec3 far_one(0.1, 0, 0), far_other(0.094, 0.0342, 0);
  Connect(graph, fork, graph.AddNode({-0.06, 0, 0}), StraightLine({0, 0, 0}, {-0.06, 0, 0}));
  Connect(graph, fork, on_one, StraightLine({0, 0, 0}, graph.position(on_one)));
  Connect(graph, fork, on_other, StraightLine({0, 0, 0}, graph.position(on_other)));
  Connect(graph, on_one, on_other, StraightLine(graph.position(on_one), graph.position(on_other)));
  Connect(graph, on_one, graph.AddNode(far_one), StraightLine(graph.position(on_one), far_one));
  Connect(graph, on_other, graph.AddNode(far_other),
          StraightLine(graph.position(on_other), far_other));
  const ObservedPoints points = NoisyWires(
      {StraightLine({-0.06, 0, 0}, far_one, 0.001), StraightLine({0, 0, 0}, far_other, 0.001)});
  RidgeEdgeOptions options;
  options.ball_radius = 0.002;  // apart from the wires, which are nearer than usual here
  options.node_clearance = 0.004;
  DropNoiseEdges(graph, points, options);
  EXPECT_EQ(graph.CycleRank(), 0);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.edge_count(), 3);
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
