#include "meshing/junction_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernel/geometry.h"
#include "meshing/stubs.h"
#include "meshing/sweep.h"
#include "meshing/watertight.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.0025;

// A straight tube of 40 mm through the origin, in segments of 5 mm.
TubePath StraightTube(const Vec3& direction, double radius = kRadius) {
  TubePath path;
  for (int i = -4; i <= 4; ++i) {
    path.axis.points.push_back(0.005 * i * direction);
    path.axis.radii.push_back(radius);
  }
  return path;
}

// Three tubes that cross at right angles, meshed as one junction of their inner segments.
struct Cross {
  Junction junction;
  TriangleMesh arms;  // the outer segments

  Cross() {
    junction.radius = kRadius;
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      const TubeRings rings = SweepRings(StraightTube(direction), 16, 0.1 + direction.y());
      junction.stubs.push_back(CloseStub(rings, 2, 6));
      for (const int point : {2, 6}) {
        const auto first = rings.vertices.begin() + rings.ring_of_point[point] * rings.sides;
        junction.cut_rings.emplace_back(first, first + rings.sides);
      }
      Append(SideOfStub(rings, 0, 2), arms);
      Append(SideOfStub(rings, 6, 8), arms);
    }
  }

  WatertightReport Examine(const JunctionMesh& mesh) const {
    TriangleMesh whole = arms;
    Append(*mesh.surface, whole);
    return ExamineMesh(whole);
  }
};

TEST(MeshJunction, UnitesAndFitsItsArms) {
  const Cross cross;
  const JunctionMesh mesh = MeshJunction(cross.junction, {}, 1);
  ASSERT_TRUE(mesh.surface);
  EXPECT_EQ(mesh.attempts, 1);
  EXPECT_EQ(mesh.last_resort, LastResort::kNone);
  const WatertightReport report = cross.Examine(mesh);
  EXPECT_EQ(report.Defects(), "");
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.genus, 0);
}

TEST(MeshJunction, LastResortFitsItsArmsToo) {
  const Cross cross;
  const JunctionMesh wrapped = MeshJunction(cross.junction, {0, true}, 1);
  ASSERT_TRUE(wrapped.surface);
  EXPECT_EQ(wrapped.last_resort, LastResort::kWrapping);
  const WatertightReport report = cross.Examine(wrapped);
  EXPECT_EQ(report.Defects(), "");
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.genus, 0);
  // Thicker by a fiftieth of the radius over half of the length, that is by 2 %; the corners of the
  // crossing are rounded within a third of the radius.
  const WatertightReport united = cross.Examine(MeshJunction(cross.junction, {}, 1));
  EXPECT_GT(report.volume / united.volume, 1.0);
  EXPECT_LT(report.volume / united.volume, 1.05);
}

TEST(MeshJunction, NothingWithoutAttemptsAndLastResort) {
  EXPECT_FALSE(MeshJunction(Cross().junction, {0, false}, 1).surface);
}

// The inner 20 mm of tubes through the origin whose directions are spread over the sphere.
Junction SpreadTubes(int count) {
  Junction junction;
  junction.radius = 0.0015;
  for (int i = 0; i < count; ++i) {
    const double z = (i + 0.5) / count;
    const double turn = 2.4 * i;  // the golden angle
    const double flat = std::sqrt(1 - z * z);
    const Vec3 direction(flat * std::cos(turn), flat * std::sin(turn), z);
    const TubeRings rings = SweepRings(StraightTube(direction, junction.radius), 12, 0.1 * i);
    junction.stubs.push_back(CloseStub(rings, 2, 6));
    for (const int point : {2, 6}) {
      const auto first = rings.vertices.begin() + rings.ring_of_point[point] * rings.sides;
      junction.cut_rings.emplace_back(first, first + rings.sides);
    }
  }
  return junction;
}

TEST(MeshJunction, WrapsACrowdedJunctionWithoutBeingAsked) {
  EXPECT_FALSE(MeshJunction(SpreadTubes(16), {0, false}, 1).surface);
  const JunctionMesh wrapped = MeshJunction(SpreadTubes(17), {0, false}, 1);
  ASSERT_TRUE(wrapped.surface);
  EXPECT_EQ(wrapped.last_resort, LastResort::kWrapping);
}

// Thin tubes that cross in one plane, each with segments of 5 mm on both sides of the middle, of
// which the last, beside the cut rings, may be shorter.
Junction PlanarFan(int count, double radius, double last_segment = 0.005) {
  Junction junction;
  junction.radius = radius;
  for (int i = 0; i < count; ++i) {
    const double turn = std::numbers::pi * i / count;
    const Vec3 direction(std::cos(turn), std::sin(turn), 0);
    TubePath tube = StraightTube(direction, radius);
    for (const int end : {-1, 1})
      tube.axis.points[4 + 2 * end] = end * (0.015 - last_segment) * direction;
    const TubeRings rings = SweepRings(tube, 8, 0.1 * i);
    junction.stubs.push_back(CloseStub(rings, 1, 7));
    for (const int point : {1, 7}) {
      const auto first = rings.vertices.begin() + rings.ring_of_point[point] * rings.sides;
      junction.cut_rings.emplace_back(first, first + rings.sides);
    }
  }
  return junction;
}

// Unions of a fan take a minute and fail: it must not even be tried.
TEST(MeshJunction, ResamplesTubesThatOverlapForLongWithoutAnAttempt) {
  const Junction fan = PlanarFan(40, 0.0004);  // 75 radii long
  const JunctionMesh mesh = MeshJunction(fan, {}, 1);
  ASSERT_TRUE(mesh.surface);
  EXPECT_EQ(mesh.attempts, 0);
  EXPECT_EQ(mesh.last_resort, LastResort::kResampling);
  const WatertightReport report = ExamineMesh(*mesh.surface);
  EXPECT_EQ(report.self_intersections, 0);
  EXPECT_EQ(report.non_manifold_edges, 0);
  EXPECT_EQ(report.non_manifold_vertices, 0);
  EXPECT_EQ(report.misoriented_edges, 0);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.boundary_edges, 2 * 40 * 8);  // the cut rings
}

// For segments so short a grid that surely reaches them has six times as many triangles.
TEST(MeshJunction, ResamplesNoFinerThanTheCutRingsNeed) {
  const JunctionMesh usual = MeshJunction(PlanarFan(40, 0.0004), {}, 1);
  const JunctionMesh fan = MeshJunction(PlanarFan(40, 0.0004, 0.0003), {}, 1);
  ASSERT_TRUE(usual.surface && fan.surface);
  EXPECT_EQ(fan.last_resort, LastResort::kResampling);
  EXPECT_LT(fan.surface->triangles.size(), 1.5 * usual.surface->triangles.size());
  const WatertightReport report = ExamineMesh(*fan.surface);
  EXPECT_EQ(report.self_intersections, 0);
  EXPECT_EQ(report.non_manifold_edges, 0);
  EXPECT_EQ(report.boundary_edges, 2 * 40 * 8);
}

}  // namespace
}  // namespace curvefusion
