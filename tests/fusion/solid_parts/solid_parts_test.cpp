#include "fusion/solid_parts/solid_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "tests/fusion/analytic_depth.h"

namespace curvefusion {
namespace {

constexpr double kVoxel = 0.005;
constexpr double kThickness = 0.01;

// A wire that stands upright over the origin.
SkeletonGraph UprightWire(double from, double to) {
  SkeletonGraph graph;
  const EdgeId id = graph.AddPolyline({{0, 0, from}, {0, 0, to}});
  graph.SetCurve(id, graph.edge(id).points, {0.003, 0.003});
  return graph;
}

Eigen::AlignedBox3d BoxAround(const SkeletonGraph& skeleton) {
  const Eigen::AlignedBox3d box = BoundsOf(skeleton);
  return {box.min() - Vec3::Constant(0.2), box.max() + Vec3::Constant(0.2)};
}

// Views half a metre away, of the eighths of a full turn that are asked for.
TsdfVolume Scanned(const DepthAlongRay& scene, const SkeletonGraph& skeleton, int views = 8) {
  TsdfVolume volume({.voxel_size = kVoxel}, BoxAround(skeleton));
  const PinholeCamera camera = KinectCamera(0.5);
  for (int i = 0; i < views; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / 8;
    const RigidTransform pose =
        LookAt({0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.45}, {0, 0, 0.07});
    volume.Integrate(RenderDepth(scene, camera, pose), camera, pose);
  }
  return volume;
}

double VolumeOf(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = mesh.vertices[a].cast<double>();
    volume += p.dot(mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>())) / 6;
  }
  return volume;
}

// Every edge runs once in each direction.
bool IsClosed(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end()) return false;
  }
  return !mesh.triangles.empty();
}

TEST(SolidParts, APotIsFoundAndTheTableIsNot) {
  const SkeletonGraph wire = UprightWire(0.115, 0.3);
  const DepthAlongRay pot = Box({-0.05, -0.05, -0.001}, {0.05, 0.05, 0.1});
  const TsdfVolume volume = Scanned(Union(pot, Plane(Vec3::UnitZ(), 0)), wire);
  const SolidParts parts = FindSolidParts(volume, BoxAround(wire), wire, kThickness);
  ASSERT_EQ(parts.solids.size(), 1);
  EXPECT_TRUE(IsClosed(parts.solids[0]));
  // Its inside, which no frame saw, is filled; edges are rounded by a voxel or two.
  EXPECT_NEAR(VolumeOf(parts.solids[0]), 1e-3, 0.1e-3);
  EXPECT_GT(parts.room_area, 0.1);
  // In its crease with the table a volume is rounded by two voxels, and smoothing adds to it.
  for (const Vec3f& v : parts.solids[0].vertices) {
    EXPECT_LT(v.head<2>().cwiseAbs().maxCoeff(), 0.05 + 3 * kVoxel);
  }
  // The wire, which ends 15 mm above, is led to it.
  double lowest = 1;
  for (const NodeId node : parts.skeleton.Nodes()) {
    lowest = std::min(lowest, parts.skeleton.position(node).z());
  }
  EXPECT_NEAR(lowest, 0.1, kVoxel);
  EXPECT_EQ(parts.skeleton.edge_count(), 1);
}

TEST(SolidParts, AHalfSeenPotIsClosedFlatBehindAndBelow) {
  const SkeletonGraph wire = UprightWire(0.115, 0.3);
  const DepthAlongRay pot = Box({-0.05, -0.05, -0.001}, {0.05, 0.05, 0.1});
  const TsdfVolume volume = Scanned(Union(pot, Plane(Vec3::UnitZ(), 0)), wire, 4);
  const SolidParts parts = FindSolidParts(volume, BoxAround(wire), wire, kThickness);
  ASSERT_EQ(parts.solids.size(), 1);
  EXPECT_TRUE(IsClosed(parts.solids[0]));
  // A skin of 10 mm on top and two or three sides would have half of that.
  EXPECT_GT(VolumeOf(parts.solids[0]), 0.7e-3);
  EXPECT_LT(VolumeOf(parts.solids[0]), 1.1e-3);
  double lowest = 1;
  for (const Vec3f& v : parts.solids[0].vertices) lowest = std::min<double>(lowest, v.z());
  EXPECT_NEAR(lowest, 0, kVoxel);  // it stands on the table
}

TEST(SolidParts, WhatIsNotAttachedIsLeftOut) {
  const SkeletonGraph wire = UprightWire(0.15, 0.3);
  const DepthAlongRay pot = Box({-0.05, -0.05, -0.001}, {0.05, 0.05, 0.1});
  const TsdfVolume volume = Scanned(Union(pot, Plane(Vec3::UnitZ(), 0)), wire);
  const SolidParts parts = FindSolidParts(volume, BoxAround(wire), wire, kThickness);
  EXPECT_TRUE(parts.solids.empty());
  EXPECT_EQ(parts.skeleton.edge(parts.skeleton.Edges()[0]).points,
            wire.edge(wire.Edges()[0]).points);
}

TEST(SolidParts, ASheetSeenFromAboveGetsTheThickness) {
  const SkeletonGraph wire = UprightWire(0.01, 0.3);
  const DepthAlongRay board = Box({-0.08, -0.08, -0.1}, {0.08, 0.08, 0});
  const DepthAlongRay seen_above = [&](const Vec3& origin, const Vec3& direction) {
    const double depth = board(origin, direction);
    return depth > 0 && (origin + depth * direction).z() > -1e-6 ? depth : 0.0;
  };
  const SolidParts parts =
      FindSolidParts(Scanned(seen_above, wire), BoxAround(wire), wire, kThickness);
  ASSERT_EQ(parts.solids.size(), 1);
  EXPECT_TRUE(IsClosed(parts.solids[0]));
  // The rim, of 5 mm, is rounded, and lies within a voxel.
  EXPECT_NEAR(VolumeOf(parts.solids[0]), 0.16 * 0.16 * kThickness, 0.15 * 0.16 * 0.16 * kThickness);
  for (const Vec3f& v : parts.solids[0].vertices) EXPECT_NEAR(v.z(), -0.005, 0.007);
}

TEST(SolidParts, AFattenedWireOnATableIsNone) {
  const SkeletonGraph wire = UprightWire(0.01, 0.3);
  const DepthAlongRay post = Box({-0.006, -0.006, -0.001}, {0.006, 0.006, 0.3});
  const TsdfVolume volume = Scanned(Union(post, Plane(Vec3::UnitZ(), 0)), wire);
  EXPECT_EQ(FindSolidParts(volume, BoxAround(wire), wire, kThickness).solids.size(), 0);
  EXPECT_FALSE(volume.ExtractMesh().triangles.empty());
}

TEST(SolidParts, AnEmptyVolumeHasNone) {
  const SkeletonGraph wire = UprightWire(0, 0.3);
  const Eigen::AlignedBox3d box(Vec3::Constant(-0.2), Vec3::Constant(0.2));
  const TsdfVolume volume({.voxel_size = kVoxel}, box);
  EXPECT_TRUE(FindSolidParts(volume, box, wire, kThickness).solids.empty());
}

}  // namespace
}  // namespace curvefusion
