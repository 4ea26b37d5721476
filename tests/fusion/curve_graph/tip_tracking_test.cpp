#include "fusion/curve_graph/tip_tracking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "graph/validate.h"
#include "kernel/polyline.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kBehind = 0.9;

// An arc of 60 mm radius and 126 mm length in the plane that faces the cameras.
Polyline Arc() {
  Polyline arc;
  for (int i = 0; i <= 63; ++i) {
    const double angle = 2.1 * i / 63 - 1.05;
    arc.emplace_back(0.06 * std::sin(angle), 0.06 * std::cos(angle) - 0.045, 0);
  }
  return arc;
}

SkeletonGraph FirstPoints(const Polyline& wire, size_t count) {
  SkeletonGraph graph;
  AddTestEdge(graph, Polyline(wire.begin(), wire.begin() + static_cast<std::ptrdiff_t>(count)));
  return graph;
}

TEST(TrackTips, FollowsABentWireToItsEndAndNoFarther) {
  const Polyline wire = Arc();
  const SilhouetteScan scan({wire}, {}, kBehind);
  SkeletonGraph graph = FirstPoints(wire, 20);
  StripViews views = scan.Strips(graph);
  EXPECT_NEAR(TrackTips(kTestRadius, views, graph), 0.088, 0.006);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_TRUE(Faults(graph).empty());
  const Polyline& curve = graph.edge(graph.Edges()[0]).points;
  double farthest = 0;
  for (const Vec3& p : curve) farthest = std::max(farthest, Project(wire, p).distance);
  EXPECT_LT(farthest, 0.004);  // a step beyond the end, and what strips reach beyond it
  EXPECT_LT(Project(curve, wire.back()).distance, 0.005);
  EXPECT_EQ(TrackTips(kTestRadius, views, graph), 0);  // it is explained now
}

TEST(TrackTips, NothingBeyondTheEndsOfWires) {
  const Polyline wire = Arc();
  const SilhouetteScan scan({wire}, {}, kBehind);
  SkeletonGraph graph = FirstPoints(wire, wire.size());
  StripViews views = scan.Strips(graph);
  EXPECT_EQ(TrackTips(kTestRadius, views, graph), 0);
  EXPECT_EQ(graph.edge_count(), 1);
}

// What is painted on a wall is no wire.
TEST(TrackTips, NothingWhereDepthShowsNothingBehind) {
  const Polyline wire = Arc();
  const SilhouetteScan scan({wire}, {}, 0.605);
  SkeletonGraph graph = FirstPoints(wire, 20);
  StripViews views = scan.Strips(graph);
  EXPECT_EQ(TrackTips(kTestRadius, views, graph), 0);
}

TEST(TrackTips, EndsWhereItMeetsAnotherCurve) {
  const Polyline wire = TestLine({-0.06, 0, 0}, {0.06, 0, 0});
  const SilhouetteScan scan({wire}, {}, kBehind);
  SkeletonGraph graph = FirstPoints(wire, 15);
  AddTestEdge(graph, Polyline(wire.end() - 15, wire.end()));
  StripViews views = scan.Strips(graph);
  TrackTips(kTestRadius, views, graph);
  EXPECT_NEAR(graph.TotalLength(), Length(wire), 0.02);
}

}  // namespace
}  // namespace curvefusion
