#include "meshing/union_resampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "meshing/dexels.h"
#include "meshing/stubs.h"
#include "meshing/sweep.h"
#include "meshing/watertight.h"
#include "tests/meshing/box_mesh.h"

namespace curvefusion {
namespace {

TriangleMesh Tube(const Vec3& from, const Vec3& to, double radius) {
  TubePath path;
  for (int i = 0; i <= 8; ++i) {
    path.axis.points.push_back(from + i / 8.0 * (to - from));
    path.axis.radii.push_back(radius);
  }
  return CloseStub(SweepRings(path, 16, 0.3), 0, 8);
}

TEST(Dexels, SpansOfOverlappingSolidsAreOne) {
  const std::vector<TriangleMesh> boxes = {
      BoxMesh({0, 0, 0}, {2, 2, 2}), BoxMesh({1, 0, 0}, {4, 2, 2}), BoxMesh({6, 0, 0}, {7, 2, 2})};
  const CubicGrid grid{Vec3(-0.5, -0.25, -0.25), 0.5};
  const Dexels dexels(boxes, grid, 0, 0);
  // y and z at -.25 + .5 k: within 0 to 2 for k = 1 to 4.
  ASSERT_EQ(dexels.lines().size(), 16u);
  for (const Dexels::Line& line : dexels.lines()) {
    ASSERT_EQ(line.spans.size(), 2u);
    EXPECT_DOUBLE_EQ(line.spans[0].from, 1);
    EXPECT_DOUBLE_EQ(line.spans[0].to, 9);
    EXPECT_DOUBLE_EQ(line.spans[1].from, 13);
  }
  EXPECT_NE(dexels.SpanAt(2, 2, 8), nullptr);
  EXPECT_EQ(dexels.SpanAt(2, 2, 9), nullptr);  // spans are half-open
  EXPECT_EQ(dexels.SpanAt(0, 2, 8), nullptr);
}

TEST(Dexels, ShortGapsAreClosed) {
  const std::vector<TriangleMesh> boxes = {BoxMesh({0, 0, 0}, {2, 2, 2}),
                                           BoxMesh({3, 0, 0}, {5, 2, 2})};
  const CubicGrid grid{Vec3(-0.25, -0.25, -0.25), 0.5};
  EXPECT_EQ(Dexels(boxes, grid, 0, 2.1).lines().front().spans.size(), 1u);
  EXPECT_EQ(Dexels(boxes, grid, 0, 1.9).lines().front().spans.size(), 2u);
}

// Every line through a corner or an edge counts once: no line enters without leaving.
TEST(Dexels, LinesThroughCornersAndEdgesAreWhole) {
  const CubicGrid grid{Vec3::Zero(), 1};
  for (int axis = 0; axis < 3; ++axis) {
    const Dexels dexels({BoxMesh({1, 1, 1}, {4, 4, 4})}, grid, axis, 0);
    ASSERT_EQ(dexels.lines().size(), 9u);  // 1 to 3, half-open
    for (const Dexels::Line& line : dexels.lines()) {
      ASSERT_EQ(line.spans.size(), 1u);
      EXPECT_EQ(line.spans[0].from, 1);
      EXPECT_EQ(line.spans[0].to, 4);
    }
  }
}

TEST(ResampleUnion, TubeKeepsItsVolume) {
  const TriangleMesh tube = Tube({0.001, 0.002, 0}, {0.03, 0.013, 0.021}, 0.002);
  const WatertightReport given = ExamineMesh(tube);
  const WatertightReport report = ExamineMesh(ResampleUnion({tube}, 0.001));
  EXPECT_EQ(report.Defects(), "");
  EXPECT_EQ(report.genus, 0);
  // Chords of up to 1.4 cells lie within the round section: 2 to 4 % of it, and the rims are cut.
  EXPECT_NEAR(report.volume / given.volume, 0.97, 0.03);
}

// Tubes that meet at half a degree: wherever the grid lies, neither holes nor handles come of it.
TEST(ResampleUnion, NearlyParallelTubesAreOneWithoutHandles) {
  for (const double angle : {0.01, 0.03, 0.1}) {
    std::vector<TriangleMesh> fan;
    for (int i = -2; i <= 2; ++i) {
      const Vec3 end(0.2 * std::cos(i * angle), 0.2 * std::sin(i * angle), 0);
      fan.push_back(Tube(Vec3::Zero(), end, 0.002));
    }
    const WatertightReport report = ExamineMesh(ResampleUnion(fan, 0.001));
    EXPECT_EQ(report.Defects(), "") << angle;
    EXPECT_EQ(report.components, 1) << angle;
    EXPECT_EQ(report.genus, 0) << angle;
  }
}

TEST(ResampleUnion, OfNothingIsNothing) { EXPECT_TRUE(ResampleUnion({}, 1).triangles.empty()); }

}  // namespace
}  // namespace curvefusion
