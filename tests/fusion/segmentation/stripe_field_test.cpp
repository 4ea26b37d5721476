#include "fusion/segmentation/stripe_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

constexpr int kSize = 80;

// Stripes of a cosine profile, whose crests are the lines p . normal = k period.
PosteriorImage Cosine(const Vec2& normal, double period_px) {
  PosteriorImage image(kSize, kSize);
  for (int v = 0; v < kSize; ++v) {
    for (int u = 0; u < kSize; ++u) {
      const double phase = 2 * std::numbers::pi * normal.dot(Vec2(u, v)) / period_px;
      image(u, v) = static_cast<uint8_t>(std::lround(127 + 120 * std::cos(phase)));
    }
  }
  return image;
}

// Distance to the nearest crest line.
double ToCrest(const Vec2& normal, double period_px, int u, int v) {
  return std::abs(std::remainder(normal.dot(Vec2(u, v)), period_px));
}

class Stripes : public testing::TestWithParam<double> {};

TEST_P(Stripes, AreFoundInTheirMiddle) {
  const double period_px = 6;
  const Vec2 normal(std::cos(GetParam()), std::sin(GetParam()));
  const StripeField stripes(Cosine(normal, period_px));
  int crests = 0;
  for (int v = 8; v < kSize - 8; ++v) {
    for (int u = 8; u < kSize - 8; ++u) {
      const double distance = ToCrest(normal, period_px, u, v);
      const StripePixel pixel = stripes.At(u, v);
      // The extremum is taken from the nearest pixel's derivatives: exact to a third of a pixel
      // where the profile is not a parabola.
      if (pixel.part == StripePart::kCrest) {
        EXPECT_LT(distance, 1.0);
        EXPECT_GT(std::abs(pixel.normal.dot(normal)), 0.97);
      }
      if (distance < 0.3) {
        EXPECT_EQ(pixel.part, StripePart::kCrest);
      }
      if (distance > period_px / 2 - 0.3) {
        EXPECT_EQ(pixel.part, StripePart::kValley);
      }
      crests += pixel.part == StripePart::kCrest;
    }
  }
  EXPECT_LT(crests, 0.4 * 64 * 64);
}

INSTANTIATE_TEST_SUITE_P(Angles, Stripes, testing::Values(0.0, 0.4, 0.785, 1.57, 2.5));

TEST(StripeField, HasPlateausWhereNothingChanges) {
  PosteriorImage image(kSize, kSize, 0);
  for (int v = 0; v < kSize; ++v) {
    for (int u = 20; u < 50; ++u) image(u, v) = 255;
  }
  const StripeField stripes(image);
  EXPECT_EQ(stripes.At(35, 40).part, StripePart::kPlateau);
  EXPECT_EQ(stripes.At(70, 40).part, StripePart::kPlateau);
  EXPECT_EQ(stripes.At(20, 40).part, StripePart::kFlank);
  EXPECT_EQ(stripes.At(0, 0).part, StripePart::kPlateau);
  EXPECT_EQ(stripes.At(kSize - 1, kSize - 1).part, StripePart::kPlateau);
}

}  // namespace
}  // namespace curvefusion
