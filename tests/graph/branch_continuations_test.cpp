#include "graph/branch_continuations.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

// A bar along x, two branches that end at it from above, at x = 0 and .03, and a bar 40 mm below.
SkeletonGraph Comb() {
  SkeletonGraph graph;
  const NodeId left = graph.AddNode({-0.05, 0, 0});
  const NodeId right = graph.AddNode({0.08, 0, 0});
  const NodeId a = graph.AddNode({0, 0, 0});
  const NodeId b = graph.AddNode({0.03, 0, 0});
  const NodeId above_a = graph.AddNode({0, 0.05, 0});
  const NodeId above_b = graph.AddNode({0.03, 0.05, 0});
  for (const auto& [from, to] :
       {std::pair{left, a}, {a, b}, {b, right}, {a, above_a}, {b, above_b}}) {
    Connect(graph, from, to, StraightLine(graph.position(from), graph.position(to)));
  }
  graph.AddPolyline(StraightLine({-0.05, -0.04, 0}, {0.08, -0.04, 0}));
  return graph;
}

std::vector<BranchContinuation> Downward(const SkeletonGraph& graph) {
  std::vector<BranchContinuation> downward;
  for (BranchContinuation& path : FindContinuations(graph)) {
    if (path.curve.back().y() < path.curve.front().y() - 0.02) downward.push_back(path);
  }
  return downward;
}

TEST(FindContinuations, LeadFromBranchesThatEndToTheCurveAhead) {
  const SkeletonGraph graph = Comb();
  const auto paths = Downward(graph);
  ASSERT_EQ(paths.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(paths[i].curve.front(), graph.position(paths[i].from));
    EXPECT_EQ(paths[i].to, -1);
    // The bar below is sampled every 1.5 mm.
    EXPECT_LT((paths[i].curve.back() - Vec3(i == 0 ? 0 : 0.03, -0.04, 0)).norm(), 0.0016);
  }
}

TEST(FindContinuations, SparesWiresThatGoOn) {
  SkeletonGraph graph = Comb();
  // The first branch goes on already, to a free end that reaches for nothing.
  const NodeId end = graph.AddNode({0, -0.12, 0});
  NodeId a = -1;
  for (const NodeId node : graph.Nodes()) {
    if (graph.position(node) == Vec3(0, 0, 0)) a = node;
  }
  Connect(graph, a, end, StraightLine({0, 0, 0}, {0, -0.12, 0}));
  const auto paths = Downward(graph);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_NEAR(paths[0].curve.front().x(), 0.03, 1e-12);
}

TEST(FindContinuations, LeadToAnEndThatFacesOnce) {
  SkeletonGraph graph;
  graph.AddPolyline(StraightLine({-0.06, 0, 0}, {0, 0, 0}));
  graph.AddPolyline(StraightLine({0.04, 0.002, 0}, {0.1, 0.002, 0}));
  const auto paths = FindContinuations(graph);
  ASSERT_EQ(paths.size(), 1u);
  EXPECT_GE(paths[0].to, 0);
  EXPECT_EQ(paths[0].curve.back(), graph.position(paths[0].to));
}

TEST(FindContinuations, ReachNoFartherThanTheyMay) {
  for (const double gap : {0.055, 0.08}) {
    SkeletonGraph graph;
    graph.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
    graph.AddPolyline(StraightLine({0.05, gap, 0}, {0.05, gap + 0.1, 0}));
    EXPECT_EQ(FindContinuations(graph).size(), gap < 0.06 ? 1u : 0u);
  }
  EXPECT_TRUE(FindContinuations({}).empty());
}

TEST(AddContinuations, MakeCyclesOfAComb) {
  SkeletonGraph graph = Comb();
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    graph.SetCurve(id, edge.points, std::vector<double>(edge.points.size(), 0.002));
  }
  EXPECT_EQ(graph.CycleRank(), 0);
  const auto paths = Downward(graph);
  AddContinuations(graph, paths);
  EXPECT_EQ(graph.CycleRank(), 1);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(CountDegree(graph, 4), 2);
  EXPECT_EQ(CountDegree(graph, 3), 2);
  for (const EdgeId id : graph.Edges()) {
    for (const double radius : graph.edge(id).radii) EXPECT_DOUBLE_EQ(radius, 0.002);
    EXPECT_EQ(graph.edge(id).radii.size(), graph.edge(id).points.size());
  }
  EXPECT_NO_THROW(Validate(graph, 1e-6, "comb"));
}

TEST(ShiftedContinuations, EndBesideEachOtherOnTheOtherEdge) {
  const SkeletonGraph graph = Comb();
  const BranchContinuation path = Downward(graph).front();
  const std::vector<BranchContinuation> paths = WithShifts(graph, path);
  ASSERT_EQ(paths.size(), 7);
  EXPECT_EQ(paths[0].curve, path.curve);
  for (size_t i = 1; i < paths.size(); ++i) {
    EXPECT_EQ(paths[i].curve.front(), path.curve.front());
    EXPECT_NEAR((paths[i].curve.back() - path.curve.back()).norm(),
                0.003 * static_cast<double>((i + 1) / 2), 1e-12);
  }
}

TEST(ShiftedContinuations, DoNotLeaveTheOtherEdge) {
  const SkeletonGraph graph = Comb();
  BranchContinuation path = Downward(graph).front();
  path.target.arc_length = 0.004;
  EXPECT_EQ(WithShifts(graph, path).size(), 5);
}

}  // namespace
}  // namespace curvefusion
