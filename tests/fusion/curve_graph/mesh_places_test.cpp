#include "fusion/curve_graph/mesh_places.h"

#include <gtest/gtest.h>

#include "fusion/curve_graph/candidate_curves.h"
#include "graph/validate.h"
#include "kernel/quantile.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kHalf = 0.072, kPitch = 0.024;
constexpr double kDepth = 0.6;  // of a closed surface, where the mesh is
const Eigen::AlignedBox3d kAround(Vec3(-0.09, -0.09, -0.04), Vec3(0.09, 0.09, 0.04));

// Bars of 5 mm every 24 mm.
std::vector<Polyline> Mesh() {
  std::vector<Polyline> bars;
  for (int i = 0; i < 7; ++i) {
    const double at = -kHalf + i * kPitch;
    bars.push_back(TestLine({at, -kHalf, 0}, {at, kHalf, 0}));
    bars.push_back(TestLine({-kHalf, at, 0}, {kHalf, at, 0}));
  }
  return bars;
}

double DistanceTo(const std::vector<Polyline>& curves, const Vec3& p) {
  double least = 1;
  for (const Polyline& curve : curves) least = std::min(least, Project(curve, p).distance);
  return least;
}

TEST(MeshPlaces, LieOnTheBarsOfAMeshThatDepthShowsClosed) {
  const SilhouetteScan scan(Mesh(), {}, kDepth, 1, true);
  const ObservedPoints places = scan.MeshPlaces(kAround);
  ASSERT_GT(places.size(), 500u);
  std::vector<double> distances;
  for (const Vec3& p : places.positions) distances.push_back(DistanceTo(Mesh(), p));
  EXPECT_LT(Median(distances), 1.2 * kTestRadius);
  EXPECT_LT(Quantile(distances, 0.9), 2 * kTestRadius);  // middles of gaps are 12 mm away
}

TEST(MeshPlaces, NoneWhereNothingStandsOut) {
  const std::vector<Vec3> plate = {{-0.2, -0.2, 0}, {0.2, -0.2, 0}, {0.2, 0.2, 0}, {-0.2, 0.2, 0}};
  EXPECT_TRUE(SilhouetteScan({}, {plate}, kDepth, 1, true).MeshPlaces(kAround).empty());
  EXPECT_TRUE(SilhouetteScan({}, {}, kDepth, 1, true).MeshPlaces(kAround).empty());
}

TEST(MeshPlaces, NoneFarFromWhatDepthShows) {
  EXPECT_TRUE(SilhouetteScan(Mesh(), {}, 0.7, 1, true).MeshPlaces(kAround).empty());
  EXPECT_TRUE(SilhouetteScan(Mesh()).MeshPlaces(kAround).empty());  // no depth measured
}

TEST(MeshPlaces, NoneWithoutBoundsOrInOnesThatAreTooWide) {
  const SilhouetteScan scan(Mesh(), {}, kDepth, 1, true);
  EXPECT_TRUE(scan.MeshPlaces({}).empty());
  EXPECT_TRUE(scan.MeshPlaces(Eigen::AlignedBox3d(Vec3::Constant(-5), Vec3::Constant(5))).empty());
}

// Places every millimetre along bars, as seen along z.
ObservedPoints PlacesOf(const std::vector<Polyline>& bars) {
  ObservedPoints places;
  for (const Polyline& bar : bars)
    for (const Vec3& p : Resample(bar, 0.001)) places.Add(p, Vec3::UnitZ(), 20);
  return places;
}

// Halves of the mesh above: bars every 12 mm.
std::vector<Polyline> CloseMesh() {
  std::vector<Polyline> bars = Mesh();
  for (Polyline& bar : bars)
    for (Vec3& p : bar) p *= 0.5;
  return bars;
}

TEST(MeshCurves, AreThoseOfTheBars) {
  const SkeletonGraph graph = MeshCurves(PlacesOf(CloseMesh()), {}, {});
  ASSERT_GT(graph.TotalLength(), 0.8);
  EXPECT_LT(graph.TotalLength(), 1.1);  // 14 bars of 72 mm
  std::vector<double> distances;
  for (const EdgeId id : graph.Edges())
    for (const Vec3& p : graph.edge(id).points) distances.push_back(DistanceTo(CloseMesh(), p));
  EXPECT_LT(Median(distances), 0.0005);
  EXPECT_LT(Quantile(distances, 0.95), 0.004);  // corners are rounded
  EXPECT_TRUE(Violations(graph, 0).empty());
}

TEST(MeshCurves, NoneAlongKnownCurvesNorOfWiresFarApart) {
  SkeletonGraph known;
  for (const Polyline& bar : CloseMesh()) AddTestEdge(known, bar);
  EXPECT_TRUE(MeshCurves(PlacesOf(CloseMesh()), {}, known).empty());
  const Polyline alone = TestLine({-0.5, 0, 0}, {0.5, 0, 0});
  EXPECT_TRUE(MeshCurves(PlacesOf({alone}), {}, {}).empty());
  EXPECT_TRUE(MeshCurves({}, {}, {}).empty());
}

// What is behind the gaps is as even as a wall on which the mesh is painted.
TEST(MeshCurves, AreNotAddedWhereColoursDoNotTellThatItIsOpen) {
  const SilhouetteScan scan(CloseMesh(), {}, kDepth, 1, true);
  SkeletonGraph graph;
  EXPECT_EQ(AddMeshCurves(scan.sequence(), PlacesOf(CloseMesh()), {}, kTestRadius, graph), 0);
  EXPECT_TRUE(graph.empty());
}

}  // namespace
}  // namespace curvefusion
