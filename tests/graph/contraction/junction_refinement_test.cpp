#include "graph/contraction/junction_refinement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

// An arm from `root` over the place where it leaves the blurred zone to its tip: straight from
// there on, bent inside, as a wide kernel leaves it.
void AddArm(SkeletonGraph& graph, NodeId root, const Vec3& junction, const Vec3& direction,
            double length = 0.05) {
  const Vec3 clear = junction + 0.006 * direction;
  const Vec3 tip = junction + length * direction;
  Polyline points = StraightLine(graph.position(root), clear);
  const Polyline straight = StraightLine(clear, tip);
  points.insert(points.end(), straight.begin() + 1, straight.end());
  Connect(graph, root, graph.AddNode(tip), points);
}

Vec3 InPlane(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

TEST(RefineJunctions, MovesAJunctionToWhereItsBranchesMeet) {
  SkeletonGraph graph;
  const Vec3 truth(0.01, 0.02, 0.03);
  const NodeId node = graph.AddNode(truth + Vec3(0.002, -0.001, 0.002));
  for (int arm = 0; arm < 3; ++arm) AddArm(graph, node, truth, InPlane(2 + 2.1 * arm));
  RefineJunctions(graph, {});
  ASSERT_EQ(Junctions(graph).size(), 1U);
  // Exact lines; the prior that holds parallel ones pulls by about 1 % of 3 mm.
  EXPECT_LT((graph.position(Junctions(graph)[0]) - truth).norm(), 0.1e-3);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "refined graph"));
  for (const EdgeId id : graph.Edges()) {  // the bent part is gone
    EXPECT_NEAR(Length(graph.edge(id).points), 0.05, 0.1e-3);
  }
}

// What the spanner makes of a crossing: two junctions of valence 3 and a short edge.
TEST(RefineJunctions, TwoHalvesOfACrossingBecomeOne) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({-0.004, 0, 0});
  const NodeId b = graph.AddNode({0.004, 0, 0});
  Connect(graph, a, b, StraightLine(graph.position(a), graph.position(b)));
  AddArm(graph, a, Vec3::Zero(), InPlane(0.75 * M_PI));
  AddArm(graph, a, Vec3::Zero(), InPlane(1.25 * M_PI));
  AddArm(graph, b, Vec3::Zero(), InPlane(0.25 * M_PI));
  AddArm(graph, b, Vec3::Zero(), InPlane(1.75 * M_PI));
  RefineJunctions(graph, {});
  ASSERT_EQ(Junctions(graph).size(), 1U);
  EXPECT_EQ(graph.Degree(Junctions(graph)[0]), 4);
  EXPECT_LT(graph.position(Junctions(graph)[0]).norm(), 0.1e-3);
  EXPECT_EQ(graph.edge_count(), 4);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "refined graph"));
}

TEST(RefineJunctions, StarInPiecesBecomesValenceSix) {
  SkeletonGraph graph;
  std::vector<NodeId> nodes;
  for (const double x : {-0.006, -0.002, 0.002, 0.006}) nodes.push_back(graph.AddNode({x, 0, 0}));
  for (int i = 0; i < 3; ++i) {
    Connect(graph, nodes[i], nodes[i + 1],
            StraightLine(graph.position(nodes[i]), graph.position(nodes[i + 1])));
  }
  AddArm(graph, nodes[0], Vec3::Zero(), -Vec3::UnitX());
  AddArm(graph, nodes[0], Vec3::Zero(), Vec3::UnitY());
  AddArm(graph, nodes[1], Vec3::Zero(), -Vec3::UnitY());
  AddArm(graph, nodes[2], Vec3::Zero(), Vec3::UnitZ());
  AddArm(graph, nodes[3], Vec3::Zero(), Vec3::UnitX());
  AddArm(graph, nodes[3], Vec3::Zero(), -Vec3::UnitZ());
  RefineJunctions(graph, {});
  ASSERT_EQ(Junctions(graph).size(), 1U);
  EXPECT_EQ(graph.Degree(Junctions(graph)[0]), 6);
  EXPECT_LT(graph.position(Junctions(graph)[0]).norm(), 0.3e-3);  // six priors of up to 6 mm
}

// Two wires end on a third from opposite sides, 11 mm apart along it.
TEST(RefineJunctions, OffsetJunctionsStayTwo) {
  SkeletonGraph graph;
  const Vec3 left(0, 0, 0);
  const Vec3 right(0.011, 0, 0);
  const NodeId a = graph.AddNode(left);
  const NodeId b = graph.AddNode(right);
  Connect(graph, a, b, StraightLine(left, right));
  AddArm(graph, a, left, -Vec3::UnitX());
  AddArm(graph, a, left, Vec3::UnitY());
  AddArm(graph, b, right, Vec3::UnitX());
  AddArm(graph, b, right, -Vec3::UnitY());
  RefineJunctions(graph, {});
  ASSERT_EQ(Junctions(graph).size(), 2U);
  EXPECT_LT((graph.position(Junctions(graph)[0]) - left).norm(), 0.2e-3);
  EXPECT_LT((graph.position(Junctions(graph)[1]) - right).norm(), 0.2e-3);
}

// A wire leaves another at 25 degrees: the ridges part only where they are 7 mm apart, 16 mm after
// the wires do.
TEST(RefineJunctions, ShallowForkIsMovedBackToWhereTheWiresMeet) {
  const double angle = 25 * M_PI / 180;
  const Vec3 fork(0.016, 0, 0);
  SkeletonGraph graph;
  const NodeId node = graph.AddNode(fork);
  Connect(graph, node, graph.AddNode({-0.06, 0, 0}), StraightLine(fork, {-0.06, 0, 0}));
  Connect(graph, node, graph.AddNode({0.08, 0, 0}), StraightLine(fork, {0.08, 0, 0}));
  Polyline branch = StraightLine(fork, 0.02 * InPlane(angle));
  const Polyline clear = StraightLine(0.02 * InPlane(angle), 0.08 * InPlane(angle));
  branch.insert(branch.end(), clear.begin() + 1, clear.end());
  Connect(graph, node, graph.AddNode(branch.back()), branch);
  RefineJunctions(graph, {});
  ASSERT_EQ(Junctions(graph).size(), 1U);
  // Along the wire the lines fix the junction 1 / sin(25 deg)^2 times worse than across it.
  EXPECT_LT(graph.position(Junctions(graph)[0]).norm(), 2e-3);
  for (const EdgeId id : graph.Edges()) {  // nobody runs back and forth
    const Polyline& points = graph.edge(id).points;
    EXPECT_LT(Length(points), 1.02 * (points.front() - points.back()).norm());
  }
}

TEST(RefineJunctions, ParallelBranchesKeepTheirJunction) {
  SkeletonGraph graph;
  const NodeId node = graph.AddNode({0, 0, 0});
  AddArm(graph, node, Vec3::Zero(), Vec3::UnitX());
  AddArm(graph, node, Vec3::Zero(), -Vec3::UnitX());
  Connect(graph, node, graph.AddNode({0.05, 0.001, 0}), StraightLine({0, 0, 0}, {0.05, 0.001, 0}));
  RefineJunctions(graph, {});
  EXPECT_LT(graph.position(node).norm(), 2e-3);
}

// A hub of eight ribs that came out as two junctions 10 mm apart.
TEST(MergeHubs, PartsOfAHubBecomeOne) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({-0.005, 0.001, 0});
  const NodeId b = graph.AddNode({0.005, 0, 0.001});
  Connect(graph, a, b, StraightLine(graph.position(a), graph.position(b)));
  for (int rib = 0; rib < 8; ++rib) {
    const Vec3 direction = InPlane((rib + 0.5) * M_PI / 4);
    AddArm(graph, direction.x() < 0 ? a : b, Vec3::Zero(), direction, 0.08);
  }
  MergeHubs(graph, {});
  ASSERT_EQ(Junctions(graph).size(), 1U);
  EXPECT_EQ(graph.Degree(Junctions(graph)[0]), 8);
  EXPECT_LT(graph.position(Junctions(graph)[0]).norm(), 0.1e-3);
  EXPECT_NO_THROW(Validate(graph, 1e-6, "merged graph"));
}

// Pairs of ribs on a bar 10 mm apart: four lines that miss one point by 5 mm.
TEST(MergeHubs, JunctionsNextToEachOtherStay) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({-0.005, 0, 0});
  const NodeId b = graph.AddNode({0.005, 0, 0});
  Connect(graph, a, b, StraightLine(graph.position(a), graph.position(b)));
  AddArm(graph, a, graph.position(a), -Vec3::UnitX());
  AddArm(graph, a, graph.position(a), Vec3::UnitY());
  AddArm(graph, b, graph.position(b), Vec3::UnitX());
  AddArm(graph, b, graph.position(b), Vec3::UnitY());
  MergeHubs(graph, {});
  EXPECT_EQ(Junctions(graph).size(), 2U);
}

// Two lines always nearly meet; nothing tells that the two forks are one junction.
TEST(MergeHubs, TooFewLinesTellNothing) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({-0.004, 0, 0});
  const NodeId b = graph.AddNode({0.004, 0, 0});
  Connect(graph, a, b, StraightLine(graph.position(a), graph.position(b)));
  AddArm(graph, a, Vec3::Zero(), InPlane(0.75 * M_PI));
  AddArm(graph, a, Vec3::Zero(), InPlane(1.25 * M_PI), 0.011);
  AddArm(graph, b, Vec3::Zero(), InPlane(0.25 * M_PI), 0.011);
  AddArm(graph, b, Vec3::Zero(), InPlane(1.75 * M_PI));
  MergeHubs(graph, {});
  EXPECT_EQ(Junctions(graph).size(), 2U);
}

TEST(RefineJunctions, CurvesWithoutJunctionsAreLeftAlone) {
  SkeletonGraph graph;
  graph.AddPolyline(Helix(0.05, 0.04, 2));
  graph.AddPolyline(Ring(0.03, 100));
  const SkeletonGraph before = graph;
  RefineJunctions(graph, {});
  EXPECT_EQ(graph.edge_count(), 2);
  for (const EdgeId id : graph.Edges()) {
    EXPECT_EQ(graph.edge(id).points, before.edge(id).points);
  }
  SkeletonGraph empty;
  RefineJunctions(empty, {});
  EXPECT_TRUE(empty.empty());
}

}  // namespace
}  // namespace curvefusion
