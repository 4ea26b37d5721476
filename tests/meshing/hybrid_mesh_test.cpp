#include "meshing/hybrid_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshing/tubes.h"
#include "tests/meshing/box_mesh.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;

TriangleMesh TubesOf(const SkeletonGraph& graph) {
  return ToTriangleMesh(BuildTubes(graph, {}).surface);
}

TriangleMesh StraightTube(const Vec3& from, const Vec3& to) {
  SkeletonGraph graph;
  AddCurve(graph, {from, to}, kRadius);
  return TubesOf(graph);
}

// A board that is not on round numbers, as no scan is.
const Vec3 kCenter(0.00113, -0.00071, 0.00037);
const Vec3 kHalf(0.0401, 0.0303, 0.0102);
const TriangleMesh kBoard =
    BoxMesh((kCenter - kHalf).cast<float>(), (kCenter + kHalf).cast<float>());

TEST(HybridMesh, AWireThroughABoardHasTheVolumeOfBoth) {
  const TriangleMesh tube = StraightTube({0, 0, -0.1}, {0, 0, 0.1});
  const HybridMesh hybrid = UniteTubesAndSolids(tube, {kBoard}, kRadius);
  EXPECT_TRUE(hybrid.report.IsWatertight());
  EXPECT_EQ(hybrid.report.components, 1);
  EXPECT_EQ(hybrid.report.genus, 0);
  EXPECT_FALSE(hybrid.resampled);
  const double board = 8 * kHalf.prod();
  const double outside = ExamineMesh(tube).volume - std::numbers::pi * kRadius * kRadius * 0.0204;
  // A polygon of 16 corners of a tube's area is round to some percent of what is inside the board.
  EXPECT_NEAR(hybrid.report.volume, board + outside, 0.001 * board);
}

TEST(HybridMesh, TubesKeepTheirDiameter) {
  const TriangleMesh tube = StraightTube({0, 0, -0.1}, {0, 0, 0.1});
  const HybridMesh hybrid = UniteTubesAndSolids(tube, {kBoard}, kRadius);
  const auto widest = [](const TriangleMesh& mesh) {
    double width = 0;
    for (const Vec3f& v : mesh.vertices) {
      if (std::abs(v.z()) > 0.02F) width = std::max<double>(width, v.head<2>().norm());
    }
    return width;
  };
  EXPECT_NEAR(widest(hybrid.mesh), widest(tube), 1e-3 * kRadius);
}

TEST(HybridMesh, AMugWithAHandleHasAHole) {
  SkeletonGraph handle;
  AddCurve(handle,
           Arc({kHalf.x(), 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 0.02, -std::numbers::pi / 2 - 0.4,
               std::numbers::pi / 2 + 0.4, 40),
           kRadius);
  const HybridMesh hybrid = UniteTubesAndSolids(TubesOf(handle), {kBoard}, kRadius);
  EXPECT_TRUE(hybrid.report.IsWatertight());
  EXPECT_EQ(hybrid.report.components, 1);
  EXPECT_EQ(hybrid.report.genus, 1);
}

TEST(HybridMesh, WhatDoesNotTouchStaysInPieces) {
  const TriangleMesh tube = StraightTube({0, 0, 0.05}, {0, 0, 0.1});
  const HybridMesh hybrid = UniteTubesAndSolids(tube, {kBoard}, kRadius);
  EXPECT_TRUE(hybrid.report.IsWatertight());
  EXPECT_EQ(hybrid.report.components, 2);
}

TEST(HybridMesh, WithoutSolidsItIsTheTubes) {
  const TriangleMesh tube = StraightTube({0, 0, 0.05}, {0, 0, 0.1});
  for (const auto& none : {std::vector<TriangleMesh>{}, std::vector<TriangleMesh>{{}}}) {
    const HybridMesh hybrid = UniteTubesAndSolids(tube, none, kRadius);
    EXPECT_EQ(hybrid.mesh.vertices, tube.vertices);
    EXPECT_EQ(hybrid.mesh.triangles, tube.triangles);
  }
}

}  // namespace
}  // namespace curvefusion
