#include "fusion/silhouettes/silhouette_topology.h"

#include <gtest/gtest.h>

#include <numbers>

#include "fusion/silhouettes/silhouette_path.h"
#include "graph/validate.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kSpacing = 0.012;  // of parallel wires
// Half a grid step of the ways through silhouettes, and what pixels of 1.25 mm add to it.
constexpr double kTolerance = 0.0015;

const Polyline kUpper = TestLine({-0.06, 0, 0}, {0.06, 0, 0});
const Polyline kLower = TestLine({-0.06, kSpacing, 0}, {0.06, kSpacing, 0});
const Polyline kRung = TestLine({0, 0, 0}, {0, kSpacing, 0});

// The upper wire without what is nearer to its middle than this.
std::vector<Polyline> UpperWithGap(double half_gap) {
  return {TestLine({-0.06, 0, 0}, {-half_gap, 0, 0}), TestLine({half_gap, 0, 0}, {0.06, 0, 0})};
}

// Behind the upper wire; some of the cameras see its middle before this.
const std::vector<Vec3> kPlate = {
    {-0.01, -0.1, 0.1}, {-0.2, -0.1, 0.1}, {-0.2, 0.1, 0.1}, {-0.01, 0.1, 0.1}};

double FarthestFrom(const Polyline& truth, const Polyline& points) {
  double farthest = 0;
  for (const Vec3& p : points) farthest = std::max(farthest, Project(truth, p).distance);
  return farthest;
}

// Two parallel wires with a rung between them.
SkeletonGraph Rows() {
  SkeletonGraph graph;
  const NodeId upper = graph.AddNode(kRung.front());
  const NodeId lower = graph.AddNode(kRung.back());
  for (const auto& [middle, y] : {std::pair{upper, 0.0}, std::pair{lower, kSpacing}}) {
    const Vec3 at(0, y, 0);
    AddTestEdge(graph, graph.AddNode({-0.06, y, 0}), middle, TestLine({-0.06, y, 0}, at));
    AddTestEdge(graph, middle, graph.AddNode({0.06, y, 0}), TestLine(at, {0.06, y, 0}));
  }
  AddTestEdge(graph, upper, lower, kRung);
  return graph;
}

// A wire across two bars, of which the stretch between them is missing.
SkeletonGraph BarsWithGap(bool with_far_stub) {
  SkeletonGraph graph;
  const NodeId near = graph.AddNode({0, -0.025, 0});
  const NodeId far = graph.AddNode({0, 0.025, 0});
  for (const auto& [node, y] : {std::pair{near, -0.025}, std::pair{far, 0.025}}) {
    AddTestEdge(graph, graph.AddNode({-0.06, y, 0}), node, TestLine({-0.06, y, 0}, {0, y, 0}));
    AddTestEdge(graph, node, graph.AddNode({0.06, y, 0}), TestLine({0, y, 0}, {0.06, y, 0}));
  }
  AddTestEdge(graph, graph.AddNode({0, -0.06, 0}), near, TestLine({0, -0.06, 0}, {0, -0.025, 0}));
  if (with_far_stub)
    AddTestEdge(graph, far, graph.AddNode({0, 0.06, 0}), TestLine({0, 0.025, 0}, {0, 0.06, 0}));
  return graph;
}

const std::vector<Polyline> kBars = {TestLine({-0.06, -0.025, 0}, {0.06, -0.025, 0}),
                                     TestLine({-0.06, 0.025, 0}, {0.06, 0.025, 0})};
const Polyline kAcross = TestLine({0, -0.06, 0}, {0, 0.06, 0});
const Polyline kBetween = TestLine({0, -0.025, 0}, {0, 0.025, 0});

std::vector<Polyline> With(std::vector<Polyline> wires, const Polyline& wire) {
  wires.push_back(wire);
  return wires;
}

TEST(SilhouettePath, FollowsAWireBesideItsGuide) {
  const SilhouetteScan scan({kUpper});
  Polyline guide;
  for (const Vec3& p : TestLine({-0.03, 0, 0}, {0.03, 0, 0}))
    guide.emplace_back(p.x(), 0.004 * std::cos(p.x() / 0.03 * std::numbers::pi / 2), 0);
  const auto path = PathThroughSilhouettes(scan.Silhouettes(), guide, 0.95);
  ASSERT_TRUE(path.has_value());
  EXPECT_EQ(path->front(), guide.front());
  EXPECT_EQ(path->back(), guide.back());
  ASSERT_GT(FarthestFrom(kUpper, guide), 0.0035);
  EXPECT_LT(FarthestFrom(kUpper, *path), kTolerance);
}

TEST(SilhouettePath, DoesNotLeaveTheWire) {
  const SilhouetteScan scan(UpperWithGap(0.01));
  EXPECT_FALSE(PathThroughSilhouettes(scan.Silhouettes(), kUpper, 0.95).has_value());
}

TEST(SilhouettePruning, DropsARungThatImagesLookPast) {
  const SilhouetteScan scan({kUpper, kLower});
  SkeletonGraph graph = Rows();
  const double removed = DropRefutedParts(scan.Shares(), 0.7, {}, graph);
  EXPECT_NEAR(removed, kSpacing, 1e-9);
  EXPECT_EQ(graph.edge_count(), 2);
  EXPECT_EQ(graph.ComponentCount(), 2);
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(SilhouettePruning, KeepsARungThatDepthShows) {
  const SilhouetteScan scan({kUpper, kLower});
  SkeletonGraph graph = Rows();
  std::vector<Vec3> places;
  for (const EdgeId id : graph.Edges()) {
    const Polyline& points = graph.edge(id).points;
    places.insert(places.end(), points.begin(), points.end());
  }
  EXPECT_EQ(DropRefutedParts(scan.Shares(), 0.7, places, graph), 0);
}

TEST(SilhouettePruning, KeepsARungThatIsThere) {
  const SilhouetteScan scan({kUpper, kLower, kRung});
  SkeletonGraph graph = Rows();
  EXPECT_EQ(DropRefutedParts(scan.Shares(), 0.7, {}, graph), 0);
  EXPECT_EQ(graph.edge_count(), 5);
}

TEST(SilhouettePruning, CutsTheEndBeyondAWire) {
  const SilhouetteScan scan({TestLine({-0.06, 0, 0}, {0.02, 0, 0})});
  SkeletonGraph graph;
  AddTestEdge(graph, kUpper);
  DropRefutedParts(scan.Shares(), 0.7, {}, graph);
  ASSERT_EQ(graph.edge_count(), 1);
  // The wire's end is a ball of its radius here; points lie every 2 mm.
  EXPECT_NEAR(graph.TotalLength(), 0.08 + kTestRadius, 0.002 + kTolerance);
}

// A stretch that has not the wires' colour shows as wire only where something wire-coloured is
// behind it.
TEST(SilhouettePruning, KeepsAStretchOfALongWireThatSomeImagesOverlook) {
  const SilhouetteScan overlooked(UpperWithGap(0.01), {kPlate});
  const double share = overlooked.Silhouettes().Share(Vec3::Zero());
  ASSERT_GT(share, 0.3);
  ASSERT_LT(share, 0.6);
  SkeletonGraph graph;
  AddTestEdge(graph, kUpper);
  EXPECT_EQ(DropRefutedParts(overlooked.Shares(), 0.7, {}, graph), 0);
  const SilhouetteScan gap(UpperWithGap(0.01));
  EXPECT_GT(DropRefutedParts(gap.Shares(), 0.7, {}, graph), 0.01);
  EXPECT_EQ(graph.edge_count(), 2);
}

// What goes on beyond it is shorter: those may as well be two wires.
TEST(SilhouettePruning, CutsAStretchBetweenShortOnesThatSomeImagesOverlook) {
  const SilhouetteScan scan(UpperWithGap(0.025), {kPlate});
  SkeletonGraph graph;
  AddTestEdge(graph, kUpper);
  EXPECT_GT(DropRefutedParts(scan.Shares(), 0.7, {}, graph), 0.01);
}

TEST(SilhouetteBridges, JoinEndsThatFaceEachOther) {
  const SilhouetteScan scan(With(kBars, kAcross));
  SkeletonGraph graph = BarsWithGap(true);
  ASSERT_EQ(graph.CycleRank(), 0);
  EXPECT_EQ(BridgeOpenEnds(scan.Silhouettes(), {}, graph), 1);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.36, 0.003);  // the way may bend by its grid
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(SilhouetteBridges, NeedTheWire) {
  const SilhouetteScan scan(With(With(kBars, TestLine({0, -0.06, 0}, {0, -0.025, 0})),
                                 TestLine({0, 0.025, 0}, {0, 0.06, 0})));
  SkeletonGraph graph = BarsWithGap(true);
  EXPECT_EQ(BridgeOpenEnds(scan.Silhouettes(), {}, graph), 0);
  EXPECT_EQ(graph.ComponentCount(), 2);
}

TEST(SilhouetteBridges, JoinAFreeEndToTheCurveAhead) {
  const SilhouetteScan scan({kBars[1], kBetween});
  SkeletonGraph graph;
  AddTestEdge(graph, kBars[1]);
  AddTestEdge(graph, TestLine({0, -0.025, 0}, {0, 0.005, 0}));
  EXPECT_EQ(JoinEndsToSides(scan.Silhouettes(), {}, graph), 1);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.edge_count(), 3);
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(SilhouetteBridges, JoinAFreeEndToTheCurveItHasJustPassed) {
  const SilhouetteScan scan({kBars[1], kBetween});
  SkeletonGraph graph;
  AddTestEdge(graph, kBars[1]);
  AddTestEdge(graph, TestLine({0.001, -0.025, 0.001}, {0.001, 0.027, 0.001}));
  EXPECT_EQ(JoinEndsToSides(scan.Silhouettes(), {}, graph), 1);
  EXPECT_EQ(graph.ComponentCount(), 1);
}

TEST(SilhouetteBridges, LeaveAFreeEndThatIsOne) {
  const SilhouetteScan scan({kBars[1], TestLine({0, -0.025, 0}, {0, 0.005, 0})});
  SkeletonGraph graph;
  AddTestEdge(graph, kBars[1]);
  AddTestEdge(graph, TestLine({0, -0.025, 0}, {0, 0.005, 0}));
  EXPECT_EQ(JoinEndsToSides(scan.Silhouettes(), {}, graph), 0);
}

TEST(SilhouetteTopology, CompletesAndPrunesAtOnce) {
  const SilhouetteScan scan(With(kBars, TestLine({0, -0.06, 0}, {0, 0.025, 0})));
  SkeletonGraph graph = BarsWithGap(false);
  AddTestEdge(graph, TestLine({0.03, -0.02, 0}, {0.03, 0.02, 0}));  // no wire
  ASSERT_TRUE(TellWires(scan.Silhouettes(), graph));
  const SilhouetteChanges changes =
      CorrectTopology(scan.Silhouettes(), scan.Shares(), {}, {}, graph);
  EXPECT_NEAR(changes.removed, 0.04, 0.002);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.325, 0.003);
  EXPECT_TRUE(Faults(graph).empty());
}

// Contraction has lost the bar between two rungs and drawn each rung round a corner into what is
// left of the bar.
TEST(SilhouetteTopology, JoinsCornersThatWereJunctions) {
  const Polyline bar = TestLine({-0.06, 0, 0}, {0.06, 0, 0});
  std::vector<Polyline> wires{bar};
  SkeletonGraph graph;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 corner(0.010 * side, 0, 0);
    wires.push_back(TestLine(corner, corner + Vec3(0, 0.05, 0)));
    Polyline bent = TestLine({0.06 * side, 0, 0}, corner);
    const Polyline rung = wires.back();
    bent.insert(bent.end(), rung.begin() + 1, rung.end());
    AddTestEdge(graph, bent);
  }
  const SilhouetteScan scan(wires);
  CorrectTopology(scan.Silhouettes(), scan.Shares(), {}, {}, graph);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.edge_count(), 5);
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(SilhouetteTopology, DoesNotTrustImagesThatDoNotShowTheCurves) {
  const SilhouetteScan scan({kUpper});
  SkeletonGraph graph;
  AddTestEdge(graph, kUpper);
  EXPECT_TRUE(TellWires(scan.Silhouettes(), graph));
  SkeletonGraph other;
  AddTestEdge(other, kBars[0]);
  EXPECT_FALSE(TellWires(scan.Silhouettes(), other));
  EXPECT_FALSE(TellWires(scan.Silhouettes(), {}));
}

}  // namespace
}  // namespace curvefusion
