#include "graph/crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "graph/validate.h"
#include "kernel/polyline.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.002;
constexpr double kReach = 0.06;   // metres, of each branch
constexpr double kStep = 0.001;   // between its points
constexpr double kDrawn = 0.010;  // so far contraction draws curves together

// How two wires cross at the origin, in planes z = -apart / 2 and apart / 2.
struct Wires {
  double apart = 2 * kRadius;
  double bend = 12;   // 1/m
  double corner = 0;  // radians, of the second at the crossing
};

Vec3 At(const Wires& wires, bool second, double t) {
  const double drawn = std::min(1.0, std::abs(t) / kDrawn);
  const double z = (second ? 0.5 : -0.5) * wires.apart * drawn * drawn * (3 - 2 * drawn);
  const double across = 0.5 * wires.bend * t * t;
  if (!second) return {t, across, z};
  return {across + std::abs(t) * std::tan(0.5 * wires.corner), t, z};
}

// Four branches from one junction.
SkeletonGraph Crossing(const Wires& wires, double radius = kRadius) {
  SkeletonGraph graph;
  const NodeId node = graph.AddNode(Vec3::Zero());
  for (const bool second : {false, true}) {
    for (const int sign : {-1, 1}) {
      Polyline points = {Vec3::Zero()};
      for (double t = kStep; t < kReach; t += kStep) points.push_back(At(wires, second, sign * t));
      const NodeId end = graph.AddNode(points.back());
      std::vector<double> radii(radius > 0 ? points.size() : 0, radius);
      std::vector<double> observations(points.size(), 7);
      graph.AddEdge({{node, end}, points, std::move(radii), std::move(observations)});
    }
  }
  return graph;
}

double LeastDistance(const Polyline& a, const Polyline& b) {
  double least = 1;
  for (const Vec3& p : a) least = std::min(least, Project(b, p).distance);
  return least;
}

TEST(SeparateCrossings, LetsLooseWiresPassEachOther) {
  SkeletonGraph graph = Crossing({});
  EXPECT_EQ(SeparateCrossings(graph), 1);
  EXPECT_TRUE(Faults(graph).empty());
  ASSERT_EQ(graph.edge_count(), 2);
  EXPECT_EQ(graph.node_count(), 4);
  EXPECT_EQ(graph.ComponentCount(), 2);
  const std::vector<EdgeId> edges = graph.Edges();
  const SkeletonEdge& first = graph.edge(edges[0]);
  const SkeletonEdge& second = graph.edge(edges[1]);
  EXPECT_NEAR(LeastDistance(first.points, second.points), 2 * kRadius, 0.0003);
  for (const SkeletonEdge* edge : {&first, &second}) {
    EXPECT_EQ(edge->radii, std::vector<double>(edge->points.size(), kRadius));
    EXPECT_EQ(edge->observations, std::vector<double>(edge->points.size(), 7));
  }
  EXPECT_EQ(SeparateCrossings(graph), 0);
}

TEST(SeparateCrossings, LeavesWiresWhoseAxesMeet) {
  SkeletonGraph graph = Crossing({.apart = 0.3 * kRadius});
  EXPECT_EQ(SeparateCrossings(graph), 0);
  EXPECT_EQ(graph.edge_count(), 4);
}

// As the bars of a grille, which are welded where they lie on each other.
TEST(SeparateCrossings, LeavesStraightWires) {
  SkeletonGraph graph = Crossing({.bend = 0});
  EXPECT_EQ(SeparateCrossings(graph), 0);
}

// As the hoops of a cage.
TEST(SeparateCrossings, LeavesWiresThatEndAtOthers) {
  SkeletonGraph graph = Crossing({});
  const std::vector<NodeId> nodes = graph.Nodes();
  for (size_t i = 1; i < nodes.size(); ++i) {
    const size_t next = i + 1 < nodes.size() ? i + 1 : 1;
    const Vec3 far = graph.position(nodes[i]) * 1.5;
    graph.AddEdge({{nodes[i], nodes[next]},
                   {graph.position(nodes[i]), far, graph.position(nodes[next])},
                   {kRadius, kRadius, kRadius},
                   {}});
  }
  EXPECT_EQ(SeparateCrossings(graph), 0);
}

// A rod that is welded to the corner of another; a star of four arms, beside whose middle noise
// leads them past each other.
TEST(SeparateCrossings, LeavesCorners) {
  SkeletonGraph welded = Crossing({.apart = 0, .corner = 1});
  EXPECT_EQ(SeparateCrossings(welded), 0);
  SkeletonGraph star = Crossing({.corner = 0.65});
  EXPECT_EQ(SeparateCrossings(star), 0);
}

TEST(SeparateCrossings, LeavesWhatHasNoRadii) {
  SkeletonGraph graph = Crossing({}, 0);
  EXPECT_EQ(SeparateCrossings(graph), 0);
  SkeletonGraph none;
  EXPECT_EQ(SeparateCrossings(none), 0);
}

// A wire that runs through a junction and back.
TEST(SeparateCrossings, LetsALoopPassItself) {
  SkeletonGraph graph = Crossing({});
  const std::vector<NodeId> nodes = graph.Nodes();
  const Vec3 a = graph.position(nodes[2]), b = graph.position(nodes[4]);
  graph.AddEdge({{nodes[2], nodes[4]},
                 {a, a + Vec3(0.05, 0.02, 0), b + Vec3(0.02, 0.05, 0), b},
                 std::vector<double>(4, kRadius),
                 std::vector<double>(4, 7)});
  graph.DissolveDegree2Nodes();
  ASSERT_EQ(graph.edge_count(), 3);
  EXPECT_EQ(SeparateCrossings(graph), 1);
  EXPECT_TRUE(Faults(graph).empty());
  EXPECT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.CycleRank(), 0);
}

}  // namespace
}  // namespace curvefusion
