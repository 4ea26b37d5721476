#include "fusion/registration/axis_depth.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

// An upright wire 5 px wide around u = `centre` at .6 m before a wall at 1 m.
DepthImage WireDepth(int centre) {
  DepthImage depth(80, 60, 1.0f);
  for (int v = 0; v < 60; ++v) {
    for (int u = centre - 2; u <= centre + 2; ++u) depth(u, v) = 0.6f;
  }
  return depth;
}

StripPlace PlaceAt(double u) { return {{u, 30}, {1, 0}, 2.5, 40, 0.605}; }

TEST(MeasureStripDepthTest, DepthOfTheWireOnly) {
  const StripDepth found = MeasureStripDepth(WireDepth(41), PlaceAt(40), 0.02);
  ASSERT_TRUE(found.measured);
  EXPECT_NEAR(found.depth, 0.6, 1e-6);  // float
  ASSERT_TRUE(found.outlined);
  EXPECT_NEAR(found.offset_px, 1, 0.25);  // steps of half a pixel
}

TEST(MeasureStripDepthTest, NothingOfTheWireMeasured) {
  EXPECT_FALSE(MeasureStripDepth(WireDepth(60), PlaceAt(40), 0.02).measured);
  EXPECT_FALSE(MeasureStripDepth(DepthImage(80, 60, 0.0f), PlaceAt(40), 0.02).measured);
}

TEST(MeasureStripDepthTest, NoOutlineBesideAnotherStrandOrOnASurface) {
  StripPlace crowded = PlaceAt(40);
  crowded.clearance_px = 10;
  EXPECT_TRUE(MeasureStripDepth(WireDepth(41), crowded, 0.02).measured);
  EXPECT_FALSE(MeasureStripDepth(WireDepth(41), crowded, 0.02).outlined);
  EXPECT_FALSE(MeasureStripDepth(DepthImage(80, 60, 0.6f), PlaceAt(40), 0.02).outlined);
}

TEST(EstimateColorShiftTest, SolvesFromNormalsInspiteOfOutliers) {
  const Vec2 shift(0.8, -0.4);
  std::vector<Vec2> normals;
  std::vector<double> offsets_px;
  for (int i = 0; i < 200; ++i) {
    normals.emplace_back(std::cos(0.1 * i), std::sin(0.1 * i));
    offsets_px.push_back(normals.back().dot(shift) + (i % 20 == 0 ? 6 : 0));
  }
  EXPECT_TRUE(EstimateColorShift(normals, offsets_px).isApprox(shift, 1e-9));  // exact data
}

TEST(EstimateColorShiftTest, ZeroWhereItCannotBeTold) {
  EXPECT_TRUE(EstimateColorShift({}, {}).isZero());
  // All wires upright: nothing is known of the shift along them.
  EXPECT_TRUE(
      EstimateColorShift(std::vector<Vec2>(100, Vec2(1, 0)), std::vector<double>(100, 1)).isZero());
}

// A hundred wires that lie say enough, however many stand.
TEST(EstimateColorShiftTest, FewLyingWiresAmongManyUprightOnesSuffice) {
  std::vector<Vec2> normals(10000, Vec2(1, 0));
  normals.insert(normals.end(), 100, Vec2(0, 1));
  std::vector<double> offsets_px(10000, 0.5);
  offsets_px.insert(offsets_px.end(), 100, -1);
  EXPECT_TRUE(EstimateColorShift(normals, offsets_px).isApprox(Vec2(0.5, -1), 1e-9));  // exact data
}

}  // namespace
}  // namespace curvefusion
