#include "graph/contraction/curve_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

// Exact ridge points on curves, 1.7 mm apart.
RidgePoints PointsOn(const std::vector<Polyline>& curves) {
  RidgePoints ridge;
  for (const Polyline& curve : curves) {
    Polyline points = Resample(curve, 1.7e-3);
    if (points.front() == points.back()) points.pop_back();
    const std::vector<Vec3> tangents = Tangents(points);
    for (size_t i = 0; i < points.size(); ++i) {
      ridge.positions.push_back(points[i]);
      ridge.directions.push_back(tangents[i]);
      ridge.strengths.push_back(1);
    }
  }
  return ridge;
}

TEST(ConnectRidgePoints, ChainBecomesOneEdge) {
  const Polyline curve = Helix(0.05, 0.04, 2);
  const SkeletonGraph graph = ConnectRidgePoints(PointsOn({curve}), {});
  ASSERT_EQ(graph.edge_count(), 1);
  // Chords of 1.7 mm shorten a circle of 50 mm by 5e-5.
  EXPECT_NEAR(graph.TotalLength(), Length(curve), 1e-4 * Length(curve));
}

TEST(ConnectRidgePoints, RingBecomesOneSelfLoop) {
  const SkeletonGraph graph = ConnectRidgePoints(PointsOn({Ring(0.03, 200)}), {});
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.node_count(), 1);
  const SkeletonEdge& edge = graph.edge(graph.Edges()[0]);
  EXPECT_EQ(edge.nodes[0], edge.nodes[1]);
  EXPECT_EQ(edge.points.front(), edge.points.back());
}

TEST(ConnectRidgePoints, RingShorterThanTheLeastLoopStaysOpen) {
  // Circumference 25 mm, less than 35 mm.
  const SkeletonGraph graph = ConnectRidgePoints(PointsOn({Ring(0.004, 100)}), {});
  EXPECT_EQ(graph.CycleRank(), 0);
  EXPECT_EQ(graph.edge_count(), 1);
}

TEST(ConnectRidgePoints, LatticeHasItsCyclesAndJunctions) {
  std::vector<Polyline> wires;
  for (int i = 0; i < 4; ++i) {
    wires.push_back({{0, 0.03 * i, 0}, {0.09, 0.03 * i, 0}});
    wires.push_back({{0.03 * i, 0, 0}, {0.03 * i, 0.09, 0}});
  }
  const SkeletonGraph graph = ConnectRidgePoints(PointsOn(wires), {});
  EXPECT_EQ(graph.CycleRank(), 9);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(CountDegree(graph, 1), 0);
}

TEST(ConnectRidgePoints, ParallelWiresFartherThanALinkStayApart) {
  std::vector<Polyline> wires;
  for (int i = 0; i < 5; ++i) wires.push_back({{0, 0.008 * i, 0}, {0.1, 0.008 * i, 0}});
  const SkeletonGraph graph = ConnectRidgePoints(PointsOn(wires), {});
  EXPECT_EQ(graph.edge_count(), 5);
  EXPECT_EQ(graph.ComponentCount(), 5);
}

// Oracle: links of any length up to the limit join exactly what reaches each other that way.
TEST(ConnectRidgePoints, ComponentsAreThoseOfTheDistanceGraph) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> inside(0, 0.06);
  RidgePoints ridge;
  for (int i = 0; i < 300; ++i) {
    ridge.positions.emplace_back(inside(random), inside(random), 0.2 * inside(random));
    ridge.directions.emplace_back(1, 0, 0);
    ridge.strengths.push_back(1);
  }
  CurveNetworkOptions options;
  options.min_spur = 0;
  std::vector<int> parent(ridge.size());
  std::iota(parent.begin(), parent.end(), 0);
  const std::function<int(int)> root = [&](int i) { return parent[i] == i ? i : root(parent[i]); };
  std::vector<int> size(ridge.size(), 0);
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < i; ++j) {
      if ((ridge.positions[i] - ridge.positions[j]).norm() <= options.max_link) {
        parent[root(i)] = root(j);
      }
    }
  }
  for (int i = 0; i < 300; ++i) ++size[root(i)];
  const auto expected = std::count_if(size.begin(), size.end(), [](int n) { return n > 1; });
  ASSERT_GT(expected, 5);
  EXPECT_EQ(ConnectRidgePoints(ridge, options).ComponentCount(), expected);
}

TEST(ConnectRidgePoints, DegenerateInput) {
  EXPECT_TRUE(ConnectRidgePoints({}, {}).empty());
  EXPECT_TRUE(ConnectRidgePoints({{Vec3::Zero()}, {Vec3::UnitX()}, {1}, {0}}, {}).empty());
  const RidgePoints coincident{
      {Vec3::Zero(), Vec3::Zero()}, {Vec3::UnitX(), Vec3::UnitX()}, {1, 1}, {0, 0}};
  EXPECT_TRUE(ConnectRidgePoints(coincident, {}).empty());
}

}  // namespace
}  // namespace curvefusion
