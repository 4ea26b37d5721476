#include "meshing/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshing/stubs.h"
#include "meshing/watertight.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
// Corner radius of a regular 16-gon of the area of the unit circle.
const double kCorner = std::sqrt(kPi / 8 / std::sin(kPi / 8));
// In radii, how far a corner may lie off: by the roughness, and by 1e-8 m of float32.
const double kRough = kCorner * kSurfaceRoughness + 1e-5;

TubePath StraightPath(double length, double radius, int points) {
  TubePath path;
  for (int i = 0; i < points; ++i) {
    path.axis.points.emplace_back(length * i / (points - 1), 0, 0);
    path.axis.radii.push_back(radius);
  }
  return path;
}

TEST(Sweep, StraightTubeWithRoundedEndsIsACapsule) {
  const TubePath path = StraightPath(0.05, 0.003, 9);
  const TriangleMesh mesh = CloseStub(SweepRings(path, 16, 0.1), 0, 8);
  const WatertightReport report = ExamineMesh(mesh);
  EXPECT_EQ(report.Defects(), "");
  EXPECT_EQ(report.genus, 0);
  const double volume = kPi * 0.003 * 0.003 * (0.05 + 4.0 / 3 * 0.003);
  // The rings have the circle's area, the domes the sphere's volume up to 1e-4.
  EXPECT_NEAR(report.volume / volume, 1, 1e-4);
}

TEST(Sweep, CutStubEndsInDiscsOverItsRings) {
  const TubeRings rings = SweepRings(StraightPath(0.05, 0.003, 9), 16, 0.1);
  const TriangleMesh stub = CloseStub(rings, 2, 5);
  EXPECT_EQ(stub.vertices.size(), 4u * 16);
  const WatertightReport report = ExamineMesh(stub);
  EXPECT_EQ(report.Defects(), "");
  // 3 of 8 segments of a prism of the circle's area; float32 coordinates carry seven digits.
  EXPECT_NEAR(report.volume / (kPi * 0.003 * 0.003 * 0.05 * 3 / 8), 1, 1e-5);
}

TEST(Sweep, FlatThinEndTapers) {
  TubePath path = StraightPath(0.05, 0.003, 5);
  path.ends[1] = {false, 0.0027};
  const TubeRings rings = SweepRings(path, 16, 0);
  const WatertightReport report = ExamineMesh(CloseStub(rings, 0, 4));
  EXPECT_EQ(report.Defects(), "");
  const Vec3f on_rim = rings.vertices[static_cast<size_t>(rings.ring_of_point[4]) * 16];
  EXPECT_NEAR(std::hypot(on_rim.y(), on_rim.z()), 0.0027 * kCorner, kRough * 0.0027);
}

TEST(Sweep, ClosedRingIsATorus) {
  TubePath path;
  path.closed = true;
  for (int i = 0; i < 96; ++i) {
    const double a = 2 * kPi * i / 96;
    path.axis.points.emplace_back(0.05 * std::cos(a), 0.05 * std::sin(a), 0.004 * std::sin(3 * a));
    path.axis.radii.push_back(0.003);
  }
  const TriangleMesh mesh = CloseStub(SweepRings(path, 16, 0.2), 0, 96);
  const WatertightReport report = ExamineMesh(mesh);
  EXPECT_EQ(report.Defects(), "");
  EXPECT_EQ(report.genus, 1);
}

TEST(Sweep, StubMayRunOverTheStartOfAClosedPath) {
  TubePath path;
  path.closed = true;
  for (int i = 0; i < 24; ++i) {
    const double a = 2 * kPi * i / 24;
    path.axis.points.emplace_back(0.05 * std::cos(a), 0.05 * std::sin(a), 0);
    path.axis.radii.push_back(0.003);
  }
  const WatertightReport report = ExamineMesh(CloseStub(SweepRings(path, 16, 0), 20, 28));
  EXPECT_EQ(report.Defects(), "");
  EXPECT_EQ(report.genus, 0);
}

// On a helix of radius R and pitch 2 pi h the rotation-minimising frame turns against the Frenet
// frame by the torsion h / (R^2 + h^2) per length.
TEST(Sweep, FramesDoNotTwistAlongAHelix) {
  const double radius = 0.02;
  const double slope = 0.005;
  const int n = 400;
  TubePath path;
  for (int i = 0; i <= n; ++i) {
    const double a = 4 * kPi * i / n;
    path.axis.points.emplace_back(radius * std::cos(a), radius * std::sin(a), slope * a);
    path.axis.radii.push_back(0.001);
  }
  const std::vector<Vec3> normals = RotationMinimisingNormals(path);
  const auto frenet_angle = [&](int i) {
    const double a = 4 * kPi * i / n;
    const Vec3 normal(-std::cos(a), -std::sin(a), 0);
    const Vec3 tangent = Vec3(-radius * std::sin(a), radius * std::cos(a), slope).normalized();
    return std::atan2(normals[i].dot(tangent.cross(normal)), normals[i].dot(normal));
  };
  const double length = 4 * kPi * std::hypot(radius, slope);
  const double torsion = slope / (radius * radius + slope * slope);
  // Two points in from the ends, where tangents are one-sided.
  const double share = static_cast<double>(n - 4) / n;
  const double turned = frenet_angle(n - 2) - frenet_angle(2) + torsion * length * share;
  // Double reflection errs with the fourth power of the step (.03 rad): far below 1e-3.
  EXPECT_NEAR(std::remainder(turned, 2 * kPi), 0, 1e-3);
}

TEST(Sweep, CornersOfFlatFacetsAreMovedByMoreThanFloatRounding) {
  const TubeRings rings = SweepRings(StraightPath(0.05, 0.003, 9), 16, 0.1);
  const auto corner = [&](int point, int k) -> Vec3 {
    return rings.vertices[static_cast<size_t>(rings.ring_of_point[point]) * 16 + k].cast<double>();
  };
  int moved = 0;
  for (int point = 1; point < 8; ++point) {
    for (int k = 0; k < 16; ++k) {
      const double off =
          ((corner(point - 1, k) + corner(point + 1, k)) / 2 - corner(point, k)).norm();
      EXPECT_LT(off, 2 * kRough * 0.003);
      moved += off > 1e-8;  // m, more than float32 rounding
    }
  }
  // Off by a sum of three random numbers of up to 1.5e-7 m, hardly one in ten is within 1e-8.
  EXPECT_GT(moved, 7 * 16 * 8 / 10);
}

TEST(Sweep, MitredRingsKeepTheTubeThick) {
  TubePath path;
  path.axis.points = {
      {0, 0, 0}, {0.03, 0, 0}, {0.03 + 0.03 / std::sqrt(2), 0.03 / std::sqrt(2), 0}};
  path.axis.radii = {0.003, 0.003, 0.003};
  const TubeRings rings = SweepRings(path, 16, 0);
  for (int k = 0; k < 16; ++k) {
    const Vec3 corner =
        rings.vertices[static_cast<size_t>(rings.ring_of_point[1]) * 16 + k].cast<double>();
    // Every corner of the mitre lies on the polygonal cylinders of both legs.
    EXPECT_NEAR(std::hypot(corner.y(), corner.z()), 0.003 * kCorner, kRough * 0.003);
  }
}

}  // namespace
}  // namespace curvefusion
