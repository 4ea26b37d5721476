#include "fusion/curve_graph/strip_views.h"

#include <gtest/gtest.h>

#include "fusion/curve_graph/line_of_sight.h"
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

TEST(LineOfSight, MeetsTheWire) {
  const SilhouetteScan scan({TestLine({0, -0.06, 0}, {0, 0.06, 0})}, {}, kBehind);
  const StripViews views = scan.Strips({}, kAround);
  const Vec3 place(0, 0.01, 0);
  const Vec3 offset = place - views.views()[3].center;
  const LineOfSight sight(views, 3, offset.normalized());
  const StripAgreement along = views.Along(place, Vec3::UnitY());
  const std::vector<double> distances = {offset.norm(), offset.norm() - 0.1};
  const std::vector<StripAgreement> looks = sight.CloseLooks(distances);
  EXPECT_EQ(looks[0].looked, along.looked);
  EXPECT_EQ(looks[0].seen, along.seen);  // which asks for the direction
  EXPECT_NEAR(sight.FirstLooks(distances)[0].looked, looks[0].looked / 5, 1);
  EXPECT_LT(looks[1].evidence, 0);
  EXPECT_FALSE(sight.IsHidden(offset.norm()));
  EXPECT_TRUE(sight.IsHidden(offset.norm() + kBehind));
}

// Places on wires and beside, before curves that explain them, outside of images and behind walls.
TEST(LineOfSight, ManyPlacesGetWhatEachGets) {
  const SilhouetteScan scan(Row(), {}, kBehind);
  SkeletonGraph known;
  AddTestEdge(known, Row()[2]);
  const StripViews views = scan.Strips(known, kAround);
  int looked = 0, seen = 0, unseen = 0;
  for (const Vec3& aim : {Vec3(kSpacing, 0.01, 0), Vec3(0, 0.01, 0), Vec3(0.1, 0.1, 0)}) {
    const LineOfSight sight(views, 2, (aim - views.views()[2].center).normalized());
    std::vector<double> distances;
    for (double at = 0.02; at < 2.5; at += 0.01) distances.push_back(at);
    const std::vector<StripAgreement> looks = sight.CloseLooks(distances);
    for (size_t i = 0; i < distances.size(); ++i) {
      // All strips run along y; across the line of sight an image counts as a whole.
      const StripAgreement one = views.Along(sight.At(distances[i]), Vec3::UnitY());
      // One: where a place lies on the edge of a pixel.
      EXPECT_NEAR(looks[i].looked, one.looked, 1) << distances[i];
      EXPECT_GE(looks[i].seen + 1, one.seen) << distances[i];
      looked += one.looked > 0;
      seen += one.seen > 0;
      unseen += one.looked == 0;
    }
  }
  EXPECT_GT(looked, 100);
  EXPECT_GT(seen, 50);
  EXPECT_GT(unseen, 100);
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
