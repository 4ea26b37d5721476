#include "fusion/strips/edge_tracking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvefusion {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr double kRadius = 0.004;  // of a strip of 8 px
constexpr double kExcessPx = 0.4;  // of the images here, by their blur

// Wire between two upright edges, which are blurred over two pixels.
void DrawWire(double left, double right, PosteriorImage& image) {
  const auto step = [](double distance) { return std::clamp(0.5 + 0.5 * distance, 0.0, 1.0); };
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const double value = 255 * std::min(step(u - left), step(right - u));
      image(u, v) = std::max(image(u, v), static_cast<uint8_t>(std::lround(value)));
    }
  }
}

// Of a wire whose edges, as seen, are half a width and the excess from u = 80 + offset.
PosteriorImage ImageOfWire(double offset, double width = 8) {
  PosteriorImage image(kWidth, kHeight, 0);
  const double half = 0.5 * width + kExcessPx;
  DrawWire(80 + offset - half, 80 + offset + half, image);
  return image;
}

ProjectedSample Expected(double v, double clearance_left, double clearance_right) {
  ProjectedSample sample;
  sample.pixel = Vec2(80, v);
  sample.tangent = Vec2(0, -1);
  sample.normal = Vec2(1, 0);
  sample.metres_per_px = 0.001;
  sample.side_clearance_px = {clearance_left, clearance_right};
  return sample;
}

std::optional<double> Centre(const PosteriorImage& image, double clearance_left,
                             double clearance_right) {
  return FindCentreByEdges(image, Expected(60, clearance_left, clearance_right), kRadius, kExcessPx,
                           5);
}

TEST(FindCentreByEdgesTest, InTheMiddleOfTwoEdgesOrHalfAWidthFromOne) {
  for (const double offset : {-3.3, -0.6, 0.0, 2.4}) {
    const PosteriorImage image = ImageOfWire(offset);
    for (const double left : {0, 16}) {
      for (const double right : {0, 16}) {
        const auto centre = Centre(image, left, right);
        EXPECT_EQ(centre.has_value(), left + right > 0);
        if (centre) {
          EXPECT_NEAR(*centre, offset, 0.1);
        }
      }
    }
  }
}

TEST(FindCentreByEdgesTest, WhatTouchesTheOtherSideDoesNotCount) {
  PosteriorImage image = ImageOfWire(1);
  DrawWire(80, 130, image);
  const auto centre = Centre(image, 16, 0);
  ASSERT_TRUE(centre);
  EXPECT_NEAR(*centre, 1, 0.1);
  EXPECT_FALSE(Centre(image, 0, 16));  // its edge is not there
  EXPECT_FALSE(Centre(image, 16, 16));
}

TEST(FindCentreByEdgesTest, NothingWhereNoEdgeOrMoreThanOneStandsOut) {
  EXPECT_FALSE(Centre(PosteriorImage(kWidth, kHeight, 0), 16, 16));
  EXPECT_FALSE(Centre(PosteriorImage(kWidth, kHeight, 255), 16, 16));
  EXPECT_FALSE(Centre(ImageOfWire(0, 14), 16, 16));  // edges too far apart
  PosteriorImage two(kWidth, kHeight, 0);
  DrawWire(70, 81, two);
  DrawWire(88, 120, two);
  EXPECT_FALSE(FindCentreByEdges(two, Expected(60, 0, 16), 0.002, kExcessPx, 40));
}

TEST(FindCentreByEdgesTest, ThinStripsHaveNoInside) {
  EXPECT_FALSE(FindCentreByEdges(ImageOfWire(0, 2.8), Expected(60, 16, 16), 0.0014, kExcessPx, 5));
}

TEST(MeasureEdgeExcessTest, WhatEdgesOfWholeStripsAreOff) {
  const PosteriorImage image = ImageOfWire(1.5);
  std::vector<WholeStrip> whole;
  for (int v = 10; v < 40; ++v) whole.push_back({Vec2(81.5, v), Vec2(1, 0), 8});
  const auto excess = MeasureEdgeExcess(image, whole);
  ASSERT_TRUE(excess);
  EXPECT_NEAR(*excess, kExcessPx, 0.1);
  whole.pop_back();
  EXPECT_FALSE(MeasureEdgeExcess(image, whole));
}

}  // namespace
}  // namespace curvefusion
