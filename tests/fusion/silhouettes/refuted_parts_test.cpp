#include "fusion/curve_graph/refuted_parts.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kSpacing = 0.012;     // of parallel wires
constexpr double kTolerance = 0.0015;  // half a pixel of 1.25 mm, twice

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

TEST(RefutedParts, DropsARungThatImagesLookPast) {
  const SilhouetteScan scan({kUpper, kLower});
  SkeletonGraph graph = Rows();
  const double removed = DropRefutedParts(scan.Shares(), 0.7, {}, graph);
  EXPECT_NEAR(removed, kSpacing, 1e-9);
  EXPECT_EQ(graph.edge_count(), 2);
  EXPECT_EQ(graph.ComponentCount(), 2);
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(RefutedParts, KeepsARungThatDepthShows) {
  const SilhouetteScan scan({kUpper, kLower});
  SkeletonGraph graph = Rows();
  std::vector<Vec3> places;
  for (const EdgeId id : graph.Edges()) {
    const Polyline& points = graph.edge(id).points;
    places.insert(places.end(), points.begin(), points.end());
  }
  EXPECT_EQ(DropRefutedParts(scan.Shares(), 0.7, places, graph), 0);
}

TEST(RefutedParts, KeepsARungThatIsThere) {
  const SilhouetteScan scan({kUpper, kLower, kRung});
  SkeletonGraph graph = Rows();
  EXPECT_EQ(DropRefutedParts(scan.Shares(), 0.7, {}, graph), 0);
  EXPECT_EQ(graph.edge_count(), 5);
}

TEST(RefutedParts, CutsTheEndBeyondAWire) {
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
TEST(RefutedParts, KeepsAStretchOfALongWireThatSomeImagesOverlook) {
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
TEST(RefutedParts, CutsAStretchBetweenShortOnesThatSomeImagesOverlook) {
  const SilhouetteScan scan(UpperWithGap(0.025), {kPlate});
  SkeletonGraph graph;
  AddTestEdge(graph, kUpper);
  EXPECT_GT(DropRefutedParts(scan.Shares(), 0.7, {}, graph), 0.01);
}

}  // namespace
}  // namespace curvefusion
