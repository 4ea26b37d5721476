#include "fusion/adjustment/color_shift.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvefusion {
namespace {

// Both edges of a strip that the depth image fattens by 1.5 px.
void AddStrip(const Vec2& normal, int frame, const Vec2& shift, std::vector<StripEdge>& edges) {
  edges.push_back({frame, normal, 1.5 - normal.dot(shift)});
  edges.push_back({frame, -normal, 1.5 + normal.dot(shift)});
}

Vec2 Direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

TEST(EstimateColorShiftTest, ShiftsOfAllFramesAndOfEachInSpiteOfOutliers) {
  const Vec2 shift(0.8, -0.4);
  const Vec2 of_frames[] = {{0.5, 0.2}, {-0.5, -0.2}};
  std::vector<StripEdge> edges;
  for (int i = 0; i < 4000; ++i) {
    AddStrip(Direction(0.1 * i), i % 2, shift + of_frames[i % 2], edges);
    if (i % 20 == 0) edges.back().beyond_px += 6;
  }
  const ColorShift found = EstimateColorShift(edges, 2);
  // Drawn to zero by some percent, as expected of edges that err together.
  EXPECT_NEAR((found.shift_px - shift).norm(), 0, 0.03);
  for (const int frame : {0, 1}) {
    EXPECT_NEAR((found.of_frames_px[frame] - of_frames[frame]).norm(), 0, 0.05);
    EXPECT_LT(found.frame_sigmas_px[frame].maxCoeff(), 0.1);
  }
}

TEST(EstimateColorShiftTest, ZeroWithoutEdges) {
  const ColorShift found = EstimateColorShift({}, 1);
  EXPECT_TRUE(found.shift_px.isZero());
  EXPECT_TRUE(found.of_frames_px[0].isZero());
  EXPECT_NEAR(found.frame_sigmas_px[0].x(), 0.5, 1e-9);  // what is expected of a frame
}

// Wires that lean by two degrees, on both sides, with a tenth of a pixel of common error that
// depends on the side: least squares alone would make a shift of 3 px along them of that.
TEST(EstimateColorShiftTest, LeaningWiresDoNotTellTheShiftAlongThem) {
  std::vector<StripEdge> edges;
  for (int i = 0; i < 2000; ++i) {
    const double lean = i % 2 == 0 ? 0.035 : -0.035;
    AddStrip(Direction(lean), 0, Vec2(i % 2 == 0 ? 0.6 : 0.4, 0), edges);
  }
  const ColorShift found = EstimateColorShift(edges, 1);
  EXPECT_NEAR(found.shift_px.x(), 0.5, 0.02);
  EXPECT_LT(std::abs(found.shift_px.y()), 0.5);
}

// A hundred edges of wires that lie say something, however many stand.
TEST(EstimateColorShiftTest, LyingWiresAmongUprightOnesSuffice) {
  std::vector<StripEdge> edges;
  for (int i = 0; i < 5000; ++i) AddStrip(Vec2::UnitX(), 0, Vec2(0.5, -1), edges);
  for (int i = 0; i < 500; ++i) AddStrip(Vec2::UnitY(), 0, Vec2(0.5, -1), edges);
  const ColorShift found = EstimateColorShift(edges, 1);
  EXPECT_NEAR(found.shift_px.x(), 0.5, 0.02);
  EXPECT_NEAR(found.shift_px.y(), -1, 0.15);
}

}  // namespace
}  // namespace curvefusion
