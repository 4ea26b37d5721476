#include "fusion/strips/strip_profile.h"

#include <gtest/gtest.h>

#include "tests/fusion/wire_images.h"

namespace curvefusion {
namespace {

constexpr Rgb kStrip = {40, 110, 50};
constexpr Rgb kBackground = {120, 115, 130};

ProjectedSample UprightSample(double x) {
  ProjectedSample sample;
  sample.pixel = Vec2(x, 30);
  sample.tangent = Vec2(0, 1);
  sample.normal = Vec2(1, 0);
  return sample;
}

StripProfile ProfileOf(double left, double right, double blur_px, double x) {
  return ReadProfile(DrawStrip(80, 60, left, right, kStrip, kBackground, blur_px), UprightSample(x),
                     24, 4);
}

TEST(StripProfileTest, ReadsColoursAlongTheNormal) {
  const StripProfile profile = ProfileOf(35, 45, 0.5, 40);
  EXPECT_EQ(profile.first_px, -24);
  ASSERT_EQ(profile.values.size(), 97u);
  EXPECT_NEAR(profile.values[48][1], 110, 1);  // the middle; rounding to 8 bits
  EXPECT_NEAR(profile.values[0][2], 130, 1);
}

TEST(FindStripTest, FindsAStripAwayFromTheProjection) {
  for (const double width : {3.0, 5.0, 9.0, 14.0}) {
    const StripProfile profile = ProfileOf(43 - 0.5 * width, 43 + 0.5 * width, 0.95, 37);
    const auto found = FindStrip(profile, 10, 16, 15);
    ASSERT_TRUE(found) << width;
    EXPECT_NEAR(found->center_px, 6, 0.75) << width;  // half a step of position and of width
    EXPECT_NEAR(found->width_px, width, 2) << width;  // a start value: the sides keep off the blur
  }
}

TEST(FindStripTest, NothingInAFlatImageOrBeyondTheSearchRange) {
  EXPECT_FALSE(FindStrip(ProfileOf(100, 110, 0.95, 37), 10, 16, 15));
  EXPECT_FALSE(FindStrip(ProfileOf(51, 55, 0.95, 37), 10, 6, 15));  // 16 px away
}

TEST(FindStripTest, AnEdgeIsNoStrip) {
  EXPECT_FALSE(FindStrip(ProfileOf(40, 200, 1.4, 38), 10, 16, 15));
}

TEST(MeasureStripTest, MassDoesNotDependOnBlur) {
  for (const double blur : {0.3, 0.9, 1.2}) {
    const auto colors = MeasureStrip(ProfileOf(37.8, 42.2, blur, 40), {0, 4.4});
    ASSERT_TRUE(colors);
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      // 8-bit rounding, and 1 % of a Gaussian's tail beyond 3 px
      EXPECT_NEAR(colors->mass[k], 4.4 * (kBackground[i] - kStrip[i]), 4) << blur;
      EXPECT_NEAR(colors->background[k], kBackground[i], 1) << blur;
    }
  }
}

TEST(MeasureStripTest, NothingWhereTheProfileEnds) {
  const StripProfile profile = ProfileOf(37, 43, 0.95, 40);
  EXPECT_TRUE(MeasureStrip(profile, {14, 6}));
  EXPECT_FALSE(MeasureStrip(profile, {18, 6}));  // 18 + 3 + 5 > 24
}

TEST(StripCentroidTest, FindsTheCentreBetweenSteps) {
  const StripProfile profile = ProfileOf(38.3, 42.3, 0.95, 40);
  const Eigen::Vector3d weights(1, 0, 1);                           // red and blue differ most
  EXPECT_NEAR(StripCentroid(profile, {0, 4}, weights), 0.3, 0.05);  // 8-bit rounding
}

}  // namespace
}  // namespace curvefusion
