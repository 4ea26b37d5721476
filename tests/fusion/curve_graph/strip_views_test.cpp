#include "fusion/curve_graph/strip_views.h"

#include <gtest/gtest.h>

#include "fusion/curve_graph/refuted_parts.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kBehind = 1.2;     // metres to what stands behind
constexpr double kSpacing = 0.015;  // of a wire array
const Eigen::AlignedBox3d kAround(Vec3(-0.06, -0.06, -0.01), Vec3(0.06, 0.06, 0.01));

std::vector<Polyline> Row() {
  std::vector<Polyline> wires;
  for (int i = -2; i <= 2; ++i)
    wires.push_back(TestLine({i * kSpacing, -0.06, 0}, {i * kSpacing, 0.06, 0}));
  return wires;
}

TEST(StripViews, ShowWhichWayAWireRuns) {
  const SilhouetteScan scan({TestLine({0, -0.06, 0}, {0, 0.06, 0})}, {}, kBehind);
  const StripViews views = scan.Strips({}, kAround);
  const Vec3 place(0, 0.01, 0);
  const StripAgreement along = views.Along(place, Vec3::UnitY());
  EXPECT_EQ(along.looked, 24);
  EXPECT_GE(along.seen, 22);
  EXPECT_EQ(views.Along(place, Vec3::UnitX()).seen, 0);
  EXPECT_EQ(views.Along(place + Vec3(0.01, 0, 0), Vec3::UnitY()).seen, 0);
}

TEST(StripViews, LineOfSightMeetsTheWire) {
  const SilhouetteScan scan({TestLine({0, -0.06, 0}, {0, 0.06, 0})}, {}, kBehind);
  const StripViews views = scan.Strips({}, kAround);
  const Vec3 place(0, 0.01, 0);
  const Vec3 offset = place - views.views()[3].center;
  const StripViews::LineOfSight sight(views, 3, offset.normalized());
  const StripAgreement along = views.Along(place, Vec3::UnitY());
  const StripAgreement look = sight.CloseLook(offset.norm());
  EXPECT_EQ(look.looked, along.looked);
  EXPECT_EQ(look.seen, along.seen);  // which asks for the direction
  EXPECT_NEAR(sight.FirstLook(offset.norm()).looked, look.looked / 5, 1);
  EXPECT_LT(sight.CloseLook(offset.norm() - 0.1).evidence, 0);
  EXPECT_FALSE(sight.IsHidden(offset.norm()));
  EXPECT_TRUE(sight.IsHidden(offset.norm() + kBehind));
}

// All images show a strip at a place of a curve that comes towards the cameras, by the same few
// pixels.
TEST(StripViews, ForeshortenedCurvesTellLittle) {
  const SilhouetteScan scan({TestLine({0, -0.06, 0}, {0, 0.06, 0})}, {}, kBehind, 0.2);
  const StripViews views = scan.Strips({}, kAround);
  const Vec3 place(0, 0.01, 0);
  const double along = views.Along(place, Vec3::UnitY()).Sum();
  EXPECT_GT(along, 5);
  EXPECT_LT(views.Along(place, Vec3::UnitZ()).Sum(), 0.25 * along);
}

// What is joined from one wire of a row to the next lies on strips in many images.
TEST(StripViews, RefuteWhatRunsAcrossARow) {
  const SilhouetteScan scan(Row(), {}, kBehind);
  const StripViews views = scan.Strips({}, kAround);
  SkeletonGraph graph;
  const Polyline wire = Row()[2];
  AddTestEdge(graph, wire);
  AddTestEdge(graph, TestLine({kSpacing, 0, 0}, {2 * kSpacing, 0.004, 0}));
  const double removed =
      DropRefutedParts([&views](const Polyline& points) { return views.SharesAlong(points); },
                       kMinStripShare, {}, graph);
  EXPECT_NEAR(removed, std::hypot(kSpacing, 0.004), 1e-6);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.edge(graph.Edges()[0]).points, wire);
}

TEST(StripViews, DoNotCountStripsThatCurvesExplain) {
  const SilhouetteScan scan(Row(), {}, kBehind);
  SkeletonGraph known;
  AddTestEdge(known, Row()[2]);
  const StripViews views = scan.Strips(known, kAround);
  EXPECT_EQ(views.Along({0, 0.01, 0}, Vec3::UnitY()).looked, 0);
  EXPECT_GE(views.Along({kSpacing, 0.01, 0}, Vec3::UnitY()).seen, 18);
}

}  // namespace
}  // namespace curvefusion
