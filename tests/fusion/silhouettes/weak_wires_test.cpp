#include "fusion/silhouettes/weak_wires.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

// Two wires, one behind the other, and a rung between them, which runs along the line of sight.
const Polyline kNear = TestLine({-0.06, 0, -0.03}, {0.06, 0, -0.03});
const Polyline kFar = TestLine({-0.06, 0, 0.03}, {0.06, 0, 0.03});
const Polyline kRung = TestLine({0, 0, -0.03}, {0, 0, 0.03});

ObservedPoints PointsAlong(const Polyline& points) {
  ObservedPoints cloud;
  for (const Vec3& p : points) cloud.Add(p, Vec3::UnitZ(), 1);
  return cloud;
}

SkeletonGraph NearAndFar() {
  SkeletonGraph graph;
  AddTestEdge(graph, kNear);
  AddTestEdge(graph, kFar);
  return graph;
}

TEST(WeakWires, AreLedToTheCurvesAtBothEnds) {
  const SilhouetteScan scan({kNear, kFar, kRung});
  SkeletonGraph graph = NearAndFar();
  const ObservedPoints seen = PointsAlong(TestLine({0, 0, -0.03}, {0, 0, -0.008}));
  EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, seen, graph), 1);
  EXPECT_EQ(graph.edge_count(), 5);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.30, 0.003);  // the way may bend by its grid
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(WeakWires, AreOneWhereDepthShowsTwoPiecesOfOne) {
  const SilhouetteScan scan({kNear, kFar, kRung});
  SkeletonGraph graph = NearAndFar();
  ObservedPoints seen = PointsAlong(TestLine({0, 0, -0.03}, {0, 0, -0.008}));
  Append(seen, PointsAlong(TestLine({0, 0, 0.008}, {0, 0, 0.02})));
  EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, seen, graph), 1);
  EXPECT_EQ(graph.edge_count(), 5);
}

TEST(WeakWires, AreShortOrAsLongAsTheStrutOfADome) {
  for (const double length : {0.032, 0.16}) {
    const double z = length / 2;
    const std::vector<Polyline> bars = {TestLine({-0.06, 0, -z}, {0.06, 0, -z}),
                                        TestLine({-0.06, 0, z}, {0.06, 0, z})};
    const SilhouetteScan scan({bars[0], bars[1], TestLine({0, 0, -z}, {0, 0, z})});
    SkeletonGraph graph;
    for (const Polyline& bar : bars) AddTestEdge(graph, bar);
    const ObservedPoints seen = PointsAlong(TestLine({0, 0, -z / 4}, {0, 0, z / 4}));
    EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, seen, graph), 1) << length;
    EXPECT_NEAR(graph.TotalLength(), 0.24 + length, 0.004);
  }
}

TEST(WeakWires, EndAtTheFirstCurveOnTheirWay) {
  const Polyline rung = TestLine({0, 0, -0.06}, {0, 0, 0.06});
  std::vector<Polyline> bars;
  for (const double z : {-0.06, 0.0, 0.06}) bars.push_back(TestLine({-0.06, 0, z}, {0.06, 0, z}));
  const SilhouetteScan scan({bars[0], bars[1], bars[2], rung});
  for (const double z : {-0.048, -0.03, -0.012}) {  // near the first, amid, near the second
    SkeletonGraph graph;
    for (const Polyline& bar : bars) AddTestEdge(graph, bar);
    const ObservedPoints seen = PointsAlong(TestLine({0, 0, z - 0.005}, {0, 0, z + 0.005}));
    EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, seen, graph), 1) << z;
    EXPECT_NEAR(graph.TotalLength(), 0.42, 0.003) << z;
    EXPECT_EQ(graph.ComponentCount(), 2) << z;
  }
}

TEST(WeakWires, NeedPoints) {
  const SilhouetteScan scan({kNear, kFar, kRung});
  SkeletonGraph graph = NearAndFar();
  EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, PointsAlong(kNear), graph), 0);
  EXPECT_EQ(graph.edge_count(), 2);
}

TEST(WeakWires, NeedImagesThatShowThemAllTheWay) {
  const SilhouetteScan scan({kNear, kFar, TestLine({0, 0, -0.03}, {0, 0, 0.01})});
  SkeletonGraph graph = NearAndFar();
  EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, PointsAlong(kRung), graph), 0);
}

TEST(WeakWires, NeedImagesFromMoreThanOneSide) {
  const std::vector<Polyline> bars = {TestLine({-0.06, -0.03, 0}, {0.06, -0.03, 0}),
                                      TestLine({-0.06, 0.03, 0}, {0.06, 0.03, 0})};
  const Polyline rung = TestLine({0, -0.03, 0}, {0, 0.03, 0});
  for (const double share_of_spread : {0.2, 1.0}) {
    const SilhouetteScan scan({bars[0], bars[1], rung}, {}, 0, share_of_spread);
    SkeletonGraph graph;
    for (const Polyline& bar : bars) AddTestEdge(graph, bar);
    EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, PointsAlong(rung), graph),
              share_of_spread < 1 ? 0 : 1);
  }
}

// Depth is noise before and behind wires, where the images show these.
TEST(WeakWires, AreNotWhatOtherCurvesHideInAllImages) {
  const double z = -0.10;
  const SilhouetteScan scan({kNear, kFar, kRung},
                            {{{-0.1, -0.1, z}, {0.1, -0.1, z}, {0.1, 0.1, z}, {-0.1, 0.1, z}}});
  SkeletonGraph graph = NearAndFar();
  for (double y = -0.1; y <= 0.1; y += 0.004)
    AddTestEdge(graph, TestLine({-0.1, y, z}, {0.1, y, z}));
  const int before = graph.edge_count();
  EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, PointsAlong(kRung), graph), 0);
  EXPECT_EQ(graph.edge_count(), before);
}

// So near a curve, images that show wire may show that curve's.
TEST(WeakWires, AreNotWhatLiesBesideACurveAllTheWay) {
  const SilhouetteScan scan(
      {}, {{{-0.1, -0.1, -0.03}, {0.1, -0.1, -0.03}, {0.1, 0.1, -0.03}, {-0.1, 0.1, -0.03}}});
  for (const double distance : {0.009, 0.016}) {
    SkeletonGraph graph;
    AddTestEdge(graph, kNear);
    for (const double x : {-0.03, 0.03})
      AddTestEdge(graph, TestLine({x, 0, -0.03}, {x, distance, -0.03}));
    const ObservedPoints seen =
        PointsAlong(TestLine({-0.03, distance, -0.03}, {0.03, distance, -0.03}));
    EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, seen, graph), distance > 0.012 ? 1 : 0);
  }
}

TEST(WeakWires, AreNoneWithoutCurves) {
  const SilhouetteScan scan({kRung});
  SkeletonGraph graph;
  EXPECT_EQ(AddWeakWires(scan.Silhouettes(), {}, PointsAlong(kRung), graph), 0);
}

}  // namespace
}  // namespace curvefusion
