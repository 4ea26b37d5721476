#include "meshing/tubes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/error.h"
#include "kernel/parallel.h"
#include "meshing/io/mesh_io.h"
#include "meshing/surface_mesh.h"
#include "meshing/tube_volume.h"
#include "tests/meshing/grazing_contacts.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;

TriangleMesh InMillimetres(const TriangleMesh& mesh) {
  TriangleMesh scaled = mesh;
  for (Vec3f& v : scaled.vertices) v = (v.cast<double>() * 1000).cast<float>();
  return scaled;
}

// Builds the tubes and checks what every result promises, also on the coordinates in millimetres.
TubeMesh BuildChecked(const SkeletonGraph& graph, size_t max_fallbacks = 0) {
  TubeMesh tubes = BuildTubes(graph, {});
  const TriangleMesh mesh = ToTriangleMesh(tubes.surface);
  const WatertightReport report = ExamineMesh(mesh);
  EXPECT_EQ(report.Defects(), "");
  EXPECT_TRUE(report.IsWatertight());
  EXPECT_EQ(report.genus, tubes.report.genus);
  EXPECT_EQ(ExamineMesh(InMillimetres(mesh)).Defects(), "");
  EXPECT_LE(tubes.fallbacks.size(), max_fallbacks);
  return tubes;
}

// The same, and the topology and volume of the true union of the tubes.
void ExpectTrue(const SkeletonGraph& graph, double volume_tolerance) {
  const TubeMesh tubes = BuildChecked(graph);
  const auto filled = FillGrazingContacts(graph, 0.02);
  ASSERT_TRUE(filled);
  EXPECT_TRUE(filled->fillings.empty());
  EXPECT_EQ(tubes.report.components - tubes.report.genus, filled->topology.euler);
  const SampledVolume truth = VolumeOfTubes(graph, 50000);
  EXPECT_NEAR(tubes.report.volume / truth.volume, 1, volume_tolerance + 4 * truth.relative_error);
}

TEST(Tubes, EmptySkeletonGivesAnEmptySurface) {
  SkeletonGraph graph;
  EXPECT_EQ(BuildTubes(graph, {}).surface.n_faces(), 0u);
  graph.AddNode({1, 2, 3});
  const TubeMesh tubes = BuildTubes(graph, {});
  EXPECT_EQ(tubes.surface.n_faces(), 0u);
  EXPECT_EQ(tubes.report.faces, 0);
}

TEST(Tubes, OneEdgeIsACapsule) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0.1, 0, 0}});
  TubeOptions options;
  options.default_radius = 0.004;
  const TubeMesh tubes = BuildTubes(graph, options);
  const double volume = kPi * 0.004 * 0.004 * (0.1 + 4.0 / 3 * 0.004);
  // The domes are polyhedra of nearly the volume of a ball.
  EXPECT_NEAR(tubes.report.volume / volume, 1, 2e-3);
  EXPECT_EQ(tubes.unions, 0);
  EXPECT_EQ(tubes.paths.size(), 1U);
}

TEST(Tubes, RingHasGenusOneAndTheVolumeOfATorus) {
  const TubeMesh tubes = BuildChecked(RingGraph(0.05, 0.003));
  EXPECT_EQ(tubes.report.genus, 1);
  EXPECT_EQ(tubes.unions, 0);
  // Chords of the simplified axis: within .04 r of the circle.
  EXPECT_NEAR(tubes.report.volume / (2 * kPi * kPi * 0.05 * 0.003 * 0.003), 1, 3e-3);
}

TEST(Tubes, CageHasTheGenusOfItsSkeleton) {
  const SkeletonGraph graph = CageGraph();
  const TubeMesh tubes = BuildChecked(graph);
  EXPECT_EQ(tubes.report.genus, graph.CycleRank());
  EXPECT_EQ(tubes.report.components, 1);
  const SampledVolume truth = VolumeOfTubes(graph, 100000);
  EXPECT_NEAR(tubes.report.volume / truth.volume, 1, 0.005 + 4 * truth.relative_error);
}

TEST(Tubes, ChairHasTheGenusOfItsSkeleton) {
  const SkeletonGraph graph = ChairGraph();
  // Of 334 unions one or two may take a second attempt.
  const TubeMesh tubes = BuildChecked(graph, 2);
  EXPECT_EQ(tubes.report.genus, graph.CycleRank());
}

TEST(Tubes, StarsOfEveryValence) {
  for (int arms = 3; arms <= 8; ++arms) {
    std::vector<Vec3> directions;
    for (int i = 0; i < arms; ++i) {
      const double a = 2 * kPi * i / arms;
      directions.emplace_back(std::cos(a), std::sin(a), 0.3 * (i % 2));
    }
    SCOPED_TRACE(arms);
    SkeletonGraph star = StarGraph(directions, 0.05, 0.003);
    ExpectTrue(star, 0.01);
  }
}

TEST(Tubes, ArmsAtTenDegrees) {
  const double a = 10 * kPi / 180;
  ExpectTrue(StarGraph({{1, 0, 0}, {std::cos(a), std::sin(a), 0}, {-1, 0, 0}}, 0.08, 0.003), 0.01);
}

TEST(Tubes, RadiusJumpOfFourToOne) {
  SkeletonGraph graph = StarGraph({{1, 0, 0}, {-1, 0.1, 0}, {0, 1, 0}}, 0.06, 0.002);
  graph.SetCurve(0, graph.edge(0).points, {0.008, 0.008});
  ExpectTrue(graph, 0.01);
}

TEST(Tubes, RadiusJumpWithinAnEdge) {
  SkeletonGraph graph;
  const EdgeId edge = graph.AddPolyline({{0, 0, 0}, {0.03, 0, 0}, {0.031, 0, 0}, {0.07, 0, 0}});
  graph.SetCurve(edge, graph.edge(edge).points, {0.008, 0.008, 0.002, 0.002});
  const TubeMesh tubes = BuildChecked(graph);
  EXPECT_EQ(tubes.report.genus, 0);
}

TEST(Tubes, OverlappingTubesThatAreNotJoinedBecomeOne) {
  SkeletonGraph graph;
  graph.AddPolyline({{-0.05, 0, 0}, {0.05, 0, 0}});
  graph.AddPolyline({{0, -0.05, 0.003}, {0, 0.05, 0.003}});
  const TubeMesh tubes = BuildChecked(graph);
  EXPECT_EQ(tubes.report.components, 1);
  EXPECT_EQ(tubes.unions, 1);
}

TEST(Tubes, TubesThatPassEachOtherStayApart) {
  SkeletonGraph graph;
  graph.AddPolyline({{-0.05, 0, 0}, {0.05, 0, 0}});
  graph.AddPolyline({{0, -0.05, 0.0053}, {0, 0.05, 0.0053}});  // a gap of .3 mm
  const TubeMesh tubes = BuildChecked(graph);
  EXPECT_EQ(tubes.report.components, 2);
}

TEST(Tubes, CoilWhoseWindingsTouchEncloses) {
  ExpectTrue(HelixGraph(0.02, 0.004, 4, 0.0025), 0.01);
}

TEST(Tubes, LatticeTighterThanItsRings) {
  const SkeletonGraph graph = LatticeGraph(3, 0.01, 0.0025);
  EXPECT_EQ(BuildChecked(graph).report.genus, graph.CycleRank());
}

TEST(Tubes, DuplicateEdgesCountOnce) {
  const SkeletonGraph single = StarGraph({{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, 0.05, 0.0025);
  SkeletonGraph doubled = single;
  for (const EdgeId id : single.Edges()) doubled.AddEdge(single.edge(id));
  // The same tubes, but other ones may carry the ball at the junction: a few facets differ.
  EXPECT_NEAR(BuildChecked(doubled).report.volume / BuildChecked(single).report.volume, 1, 1e-3);
}

TEST(Tubes, SkeletonsSmallerThanTheTubeBecomeBlobs) {
  for (const double length : {1e-9, 1e-5, 1e-3}) {
    SkeletonGraph graph;
    graph.AddPolyline({{0.1, 0.2, 0.3}, {0.1 + length, 0.2, 0.3}});
    graph.AddPolyline({{0.2, 0, 0}, {0.2 + length, 0, 0}, {0.2, length, 0}, {0.2, 0, 0}});
    const TubeMesh tubes = BuildChecked(graph);
    EXPECT_EQ(tubes.report.components, 2) << length;
    EXPECT_EQ(tubes.report.genus, 0) << length;
  }
}

TEST(Tubes, FarFromTheOrigin) {
  SkeletonGraph graph = StarGraph({{1, 0, 0}, {-1, 1, 0}, {-1, -1, 0.5}}, 0.05, 0.0025);
  for (const NodeId node : graph.Nodes())
    graph.MoveNode(node, graph.position(node) + Vec3(9, 8, 7));
  BuildChecked(graph);
  for (const NodeId node : graph.Nodes()) {
    graph.MoveNode(node, graph.position(node) + Vec3(1e4, 0, 0));
  }
  EXPECT_THROW(BuildTubes(graph, {}), Error);
}

TEST(Tubes, BadRadiiAndCoordinatesAreErrors) {
  for (const double radius : {0.0, -1e-3, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    SkeletonGraph graph = RingGraph(0.05, 0.0025);
    const Polyline points = graph.edge(0).points;
    graph.SetCurve(0, points, std::vector<double>(points.size(), radius));
    EXPECT_THROW(BuildTubes(graph, {}), Error) << radius;
  }
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}, {1, 0, 0}});
  EXPECT_THROW(BuildTubes(graph, {}), Error);
}

TEST(Tubes, SameSurfaceForAnyNumberOfThreads) {
  const SkeletonGraph graph = LatticeGraph(3, 0.02, 0.0025);
  const TriangleMesh many = ToTriangleMesh(BuildTubes(graph, {}).surface);
  const ThreadLimit limit(1);
  const TriangleMesh one = ToTriangleMesh(BuildTubes(graph, {}).surface);
  EXPECT_EQ(one.vertices, many.vertices);
  EXPECT_EQ(one.triangles, many.triangles);
}

TEST(Tubes, EveryNumberOfSides) {
  TubeOptions options;
  for (const int sides : {8, 11, 32, 64}) {
    options.sides = sides;
    const TubeMesh tubes = BuildTubes(LatticeGraph(2, 0.03, 0.0025), options);
    EXPECT_EQ(tubes.report.genus, 5) << sides;  // a cube has 12 edges and 8 nodes
  }
}

}  // namespace
}  // namespace curvefusion
