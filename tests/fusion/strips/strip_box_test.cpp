#include "fusion/strips/strip_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fusion/wire_images.h"

namespace curvefusion {
namespace {

constexpr Rgb kStrip = {40, 110, 50};
constexpr Rgb kBackground = {150, 140, 160};

TEST(StripBoxTest, MeasuresOneStripInABox) {
  for (const int width : {4, 6, 8}) {
    const ColorImage image = DrawStrip(80, 60, 39.5, 39.5 + width, kStrip, kBackground, 0.7);
    // Canny puts edges on whole pixels
    EXPECT_NEAR(StripWidthInBox(LabelStrips(image, 16), {41, 30}, 16), width, 1) << width;
  }
}

// A round wire is darker towards the side that light does not reach, and the edge there lies
// within.
TEST(StripBoxTest, ARoundWireLitFromTheSideComesOutTooThin) {
  constexpr int kWidth = 6;
  ColorImage image(80, 60, Rgb{60, 60, 60});
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double x = (2 * u + 1.0) / kWidth - 1;                   // across the wire, -1 to 1
      const double lambert = 0.5 * std::sqrt(1 - x * x) - 0.87 * x;  // light from 60 degrees aside
      const auto grey = static_cast<uint8_t>(180 * (0.35 + 0.65 * std::max(0.0, lambert)));
      image(40 + u, v) = {grey, grey, grey};
    }
  }
  const double width = StripWidthInBox(LabelStrips(image, 16), {43, 30}, 16);
  EXPECT_GT(width, 0);
  EXPECT_LT(width, kWidth - 1);
}

TEST(StripBoxTest, ABoxWithoutStripIsDiscarded) {
  const ColorImage image = DrawStrip(80, 60, 39.5, 44.5, kStrip, kBackground, 0.7);
  const StripRegions regions = LabelStrips(image, 16);
  EXPECT_EQ(StripWidthInBox(regions, {15, 30}, 16), 0);
  EXPECT_EQ(StripWidthInBox(regions, {2, 30}, 16), 0);  // reaches over the border
}

TEST(StripBoxTest, ABoxWithTwoStripsIsDiscarded) {
  ColorImage image = DrawStrip(80, 60, 35.5, 39.5, kStrip, kBackground, 0.7);
  const ColorImage other = DrawStrip(80, 60, 43.5, 47.5, kStrip, kBackground, 0.7);
  for (int v = 0; v < 60; ++v) {
    for (int u = 42; u < 80; ++u) image(u, v) = other(u, v);
  }
  EXPECT_EQ(StripWidthInBox(LabelStrips(image, 16), {41, 30}, 16), 0);
}

TEST(StripBoxTest, WiderStripsThanTheBoxAreNone) {
  const ColorImage image = DrawStrip(80, 60, 30, 55, kStrip, kBackground, 0.7);
  EXPECT_EQ(StripWidthInBox(LabelStrips(image, 16), {42, 30}, 16), 0);
}

}  // namespace
}  // namespace curvefusion
