#include "fusion/curve_graph/strip_snapping.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "graph/validate.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

const Polyline kWire = TestLine({-0.05, -0.06, 0.01}, {0.05, 0.06, -0.01});

double FarthestFromWire(const SkeletonGraph& graph) {
  double farthest = 0;
  for (const EdgeId id : graph.Edges())
    for (const Vec3& p : graph.edge(id).points)
      farthest = std::max(farthest, Project(kWire, p).distance);
  return farthest;
}

Eigen::AlignedBox3d Bounds(const Polyline& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

Polyline Moved(Polyline points, const Vec3& by) {
  for (Vec3& p : points) p += by;
  return points;
}

TEST(SnapToStrips, MovesACurveOntoItsWire) {
  const SilhouetteScan scan({kWire});
  SkeletonGraph graph;
  AddTestEdge(graph, Moved(kWire, {0.0016, -0.0013, 0.002}));
  EXPECT_GT(FarthestFromWire(graph), 0.0025);
  const double length = graph.TotalLength();
  SnapToStrips(scan.Strips({}, Bounds(kWire)), graph);
  EXPECT_LT(FarthestFromWire(graph), 0.001);
  EXPECT_NEAR(graph.TotalLength(), length, 0.003);
  EXPECT_TRUE(Faults(graph).empty());
}

TEST(SnapToStrips, EdgesThatMeetStillDo) {
  const SilhouetteScan scan({kWire});
  SkeletonGraph graph;
  const Polyline moved = Moved(kWire, {0.002, -0.001, 0.001});
  const EdgeId id = AddTestEdge(graph, moved);
  graph.SplitEdge(id, moved.size() / 2);
  ASSERT_EQ(graph.edge_count(), 2);
  SnapToStrips(scan.Strips({}, Bounds(kWire)), graph);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_TRUE(Faults(graph).empty());
  EXPECT_LT(FarthestFromWire(graph), 0.0012);
}

TEST(SnapToStrips, NothingMovesWhereNoImageShowsAnything) {
  const SilhouetteScan scan({kWire});
  SkeletonGraph graph;
  const Polyline elsewhere = Moved(kWire, {0.05, -0.04, 0});
  AddTestEdge(graph, elsewhere);
  SnapToStrips(scan.Strips({}, Bounds(elsewhere)), graph);
  const Polyline& points = graph.edge(graph.Edges()[0]).points;
  for (size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((points[i] - elsewhere[i]).norm(), 1e-9) << i;
}

}  // namespace
}  // namespace curvefusion
