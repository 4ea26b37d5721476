#include "meshing/watertight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "kernel/error.h"
#include "meshing/self_intersections.h"
#include "meshing/surface_mesh.h"
#include "tests/meshing/box_mesh.h"

namespace curvefusion {
namespace {

TriangleMesh Cube(const Vec3f& low, float size, bool inside_out = false) {
  TriangleMesh mesh = BoxMesh(low, low + Vec3f::Constant(size));
  if (inside_out) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  }
  return mesh;
}

TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh joined = a;
  Append(b, joined);
  return joined;
}

TEST(ExamineMesh, CubeIsWatertight) {
  const WatertightReport report = ExamineMesh(Cube({1, 2, 3}, 2));
  EXPECT_TRUE(report.IsWatertight()) << report.Defects();
  EXPECT_EQ(report.vertices, 8);
  EXPECT_EQ(report.faces, 12);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.genus, 0);
  EXPECT_DOUBLE_EQ(report.volume, 8);
  EXPECT_DOUBLE_EQ(report.area, 24);
  EXPECT_NEAR(report.min_angle, M_PI / 4, 1e-12);
}

TEST(ExamineMesh, CountsAsReadersOfTheFileDo) {
  // Every triangle with vertices of its own, as in an STL file.
  const TriangleMesh cube = Cube({0, 0, 0}, 1);
  TriangleMesh soup;
  for (const auto& triangle : cube.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (const int v : triangle) soup.vertices.push_back(cube.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(ExamineMesh(soup).IsWatertight());
}

TEST(ExamineMesh, EmptyMeshIsNotWatertight) {
  const WatertightReport report = ExamineMesh({});
  EXPECT_FALSE(report.IsWatertight());
  EXPECT_EQ(report.Defects(), "");
}

TEST(ExamineMesh, ReportsAnOpenMesh) {
  TriangleMesh mesh = Cube({0, 0, 0}, 1);
  mesh.triangles.pop_back();
  const WatertightReport report = ExamineMesh(mesh);
  EXPECT_FALSE(report.IsWatertight());
  EXPECT_EQ(report.boundary_edges, 3);
  ASSERT_TRUE(report.defect_place);
}

TEST(ExamineMesh, ReportsAFlippedTriangle) {
  TriangleMesh mesh = Cube({0, 0, 0}, 1);
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const WatertightReport report = ExamineMesh(mesh);
  EXPECT_FALSE(report.IsWatertight());
  EXPECT_EQ(report.misoriented_edges, 3);
}

TEST(ExamineMesh, ReportsSelfIntersections) {
  const WatertightReport report =
      ExamineMesh(Joined(Cube({0, 0, 0}, 1), Cube({0.5f, 0.5f, 0.5f}, 1)));
  EXPECT_FALSE(report.IsWatertight());
  EXPECT_GT(report.self_intersections, 0);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.misoriented_edges, 0);
}

TEST(ExamineMesh, ReportsAVertexPushedThroughTheOtherSide) {
  TriangleMesh mesh = Cube({0, 0, 0}, 1);
  mesh.vertices[7] = {-0.2f, -0.3f, -0.4f};
  EXPECT_GT(ExamineMesh(mesh).self_intersections, 0);
}

TEST(ExamineMesh, ReportsFoldedNeighbours) {
  // Two triangles on one edge, in one plane, on the same side of it.
  const TriangleMesh folded{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 0, 3}}};
  EXPECT_EQ(FindSelfIntersections(folded).size(), 1u);
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -1, 0}}, {{0, 1, 2}, {1, 0, 3}}};
  EXPECT_TRUE(FindSelfIntersections(flat).empty());
}

TEST(ExamineMesh, ReportsTouchingCubes) {
  const WatertightReport at_corner = ExamineMesh(Joined(Cube({0, 0, 0}, 1), Cube({1, 1, 1}, 1)));
  EXPECT_EQ(at_corner.non_manifold_vertices, 1);
  const WatertightReport at_edge = ExamineMesh(Joined(Cube({0, 0, 0}, 1), Cube({1, 1, 0}, 1)));
  EXPECT_EQ(at_edge.non_manifold_edges, 1);
}

TEST(ExamineMesh, ReportsTrianglesWithoutArea) {
  TriangleMesh mesh = Cube({0, 0, 0}, 1);
  mesh.vertices[1] = mesh.vertices[0];
  EXPECT_GT(ExamineMesh(mesh).degenerate_faces, 0);
}

TEST(ExamineMesh, CavitiesFaceInwards) {
  const TriangleMesh outer = Cube({0, 0, 0}, 4);
  const WatertightReport hollow = ExamineMesh(Joined(outer, Cube({1, 1, 1}, 2, true)));
  EXPECT_TRUE(hollow.IsWatertight()) << hollow.Defects();
  EXPECT_DOUBLE_EQ(hollow.volume, 64 - 8);
  EXPECT_EQ(ExamineMesh(Joined(outer, Cube({1, 1, 1}, 2))).misplaced_components, 1);
  EXPECT_EQ(ExamineMesh(Cube({0, 0, 0}, 1, true)).misplaced_components, 1);
}

TEST(ExamineMesh, RefusesWhatIsNoMesh) {
  TriangleMesh mesh = Cube({0, 0, 0}, 1);
  mesh.triangles[3][1] = 8;
  EXPECT_THROW(ExamineMesh(mesh), Error);
  mesh = Cube({0, 0, 0}, 1);
  mesh.vertices[2].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(ExamineMesh(mesh), Error);
}

TEST(SurfaceMesh, RoundTripKeepsTheMesh) {
  const TriangleMesh cube = Cube({0, 0, 0}, 1);
  const auto surface = ToSurfaceMesh(cube);
  ASSERT_TRUE(surface);
  const TriangleMesh back = ToTriangleMesh(*surface);
  EXPECT_EQ(back.vertices, cube.vertices);
  EXPECT_DOUBLE_EQ(ExamineMesh(back).volume, 1);
}

TEST(SurfaceMesh, RefusesWhatIsNotManifold) {
  TriangleMesh cube = Cube({0, 0, 0}, 1);
  std::swap(cube.triangles[5][0], cube.triangles[5][1]);
  EXPECT_FALSE(ToSurfaceMesh(cube));
}

}  // namespace
}  // namespace curvefusion
