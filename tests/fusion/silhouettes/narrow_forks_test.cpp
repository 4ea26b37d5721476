#include "fusion/silhouettes/narrow_forks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusion/silhouettes/silhouette_topology.h"
#include "graph/validate.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

// Two wires that meet another at 12 degrees; between them everything looks like wire.
constexpr double kHalfAngle = 0.1;  // radians
constexpr double kReach = 0.21;     // metres
const Vec3 kTip(-0.11, 0, 0);

Vec3 OnStrand(int side, double length) {
  return kTip + length * Vec3(std::cos(kHalfAngle), side * std::sin(kHalfAngle), 0);
}

const Polyline kThird = TestLine(kTip, kTip + Vec3(0.01, 0, 0.06));
const std::vector<Polyline> kStrands = {TestLine(kTip, OnStrand(-1, kReach)),
                                        TestLine(kTip, OnStrand(1, kReach))};
// A wire that meets one of both from outside.
constexpr double kRungAt = 0.1;
const Polyline kRung = TestLine(OnStrand(1, kRungAt) + Vec3(0, 0.05, 0), OnStrand(1, kRungAt));
const std::vector<Vec3> kSheet = {kTip, OnStrand(-1, 0.15), OnStrand(1, 0.15)};

// What contraction makes of them: one curve in the middle that divides where the wires are apart.
SkeletonGraph MergedCurve(bool with_third) {
  SkeletonGraph graph;
  const NodeId tip = graph.AddNode(kTip);
  const NodeId rung = graph.AddNode(kTip + Vec3(kRungAt, 0, 0));
  const NodeId fork = graph.AddNode(kTip + Vec3(0.13, 0, 0));
  AddTestEdge(graph, tip, rung, TestLine(graph.position(tip), graph.position(rung)));
  AddTestEdge(graph, rung, fork, TestLine(graph.position(rung), graph.position(fork)));
  for (const int side : {-1, 1}) {
    Polyline arm = TestLine(graph.position(fork), OnStrand(side, 0.15));
    const Polyline wire = TestLine(OnStrand(side, 0.15), OnStrand(side, kReach));
    arm.insert(arm.end(), wire.begin() + 1, wire.end());
    AddTestEdge(graph, fork, graph.AddNode(arm.back()), arm);
  }
  Polyline bent = kRung;
  bent.back() = graph.position(rung);
  AddTestEdge(graph, graph.AddNode(kRung.front()), rung, bent);
  if (with_third) AddTestEdge(graph, tip, graph.AddNode(kThird.back()), kThird);
  return graph;
}

// The distance of the farthest point of a curve from all wires.
double FarthestFromWires(const SkeletonGraph& graph, const std::vector<Polyline>& wires) {
  double farthest = 0;
  for (const EdgeId id : graph.Edges()) {
    for (const Vec3& p : graph.edge(id).points) {
      double nearest = 1;
      for (const Polyline& wire : wires) nearest = std::min(nearest, Project(wire, p).distance);
      farthest = std::max(farthest, nearest);
    }
  }
  return farthest;
}

const std::vector<Polyline> kWires = {kStrands[0], kStrands[1], kThird, kRung};

TEST(NarrowForks, LeadBothWiresToWhereTheyMeet) {
  const SilhouetteScan scan(kWires, {kSheet});
  SkeletonGraph graph = MergedCurve(true);
  ASSERT_GT(FarthestFromWires(graph, kWires), 0.009);
  EXPECT_EQ(PartNarrowForks(scan.Silhouettes(), graph), 1);
  // An arm begins between two samples, at a vertex.
  EXPECT_LT(FarthestFromWires(graph, kWires), 0.001);
  EXPECT_TRUE(Faults(graph).empty());
  EXPECT_EQ(graph.ComponentCount(), 2);  // the wire from beside ends freely
  EXPECT_EQ(PartNarrowForks(scan.Silhouettes(), graph), 0);
}

TEST(NarrowForks, AreJoinedByWhatCameFromBeside) {
  const SilhouetteScan scan(kWires, {kSheet});
  SkeletonGraph graph = MergedCurve(true);
  EXPECT_EQ(CorrectTopology(scan.Silhouettes(), scan.Shares(), {}, {}, graph).forks, 1);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.CycleRank(), 0);
  int junctions = 0;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) != 3) continue;
    ++junctions;
    const Vec3& p = graph.position(node);
    // The last millimetres of the wire point at the curve that is no more.
    EXPECT_LT(std::min((p - kTip).norm(), (p - OnStrand(1, kRungAt)).norm()), 0.004);
  }
  EXPECT_EQ(junctions, 2);
}

TEST(NarrowForks, AreNoneWhereImagesLookBetween) {
  SkeletonGraph graph = MergedCurve(true);
  std::vector<Polyline> wires;
  for (const EdgeId id : graph.Edges()) wires.push_back(graph.edge(id).points);
  const SilhouetteScan scan(wires);
  EXPECT_EQ(PartNarrowForks(scan.Silhouettes(), graph), 0);
}

TEST(NarrowForks, AreNoneWhereACurveGoesOn) {
  const SilhouetteScan scan(kWires, {kSheet});
  SkeletonGraph graph = MergedCurve(false);
  const NodeId tip = graph.Nodes()[0];
  const Vec3 beyond = kTip - Vec3(0.03, 0, 0);
  AddTestEdge(graph, tip, graph.AddNode(beyond), TestLine(kTip, beyond));
  EXPECT_EQ(PartNarrowForks(scan.Silhouettes(), graph), 0);
}

}  // namespace
}  // namespace curvefusion
