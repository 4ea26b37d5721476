#include "fusion/strips/vanishing_color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace curvefusion {
namespace {

const Eigen::Vector3d kWire(60, 140, 70);

// A strip of that colour, taken to be `too_wide` times as wide as it is; its centre, which blur has
// mixed with the background, says nothing.
ColoredStrip Strip(int frame, double width_px, double too_wide, const Eigen::Vector3d& background,
                   const Eigen::Vector3d& wire) {
  ColoredStrip strip;
  strip.frame = frame;
  strip.width_px = too_wide * width_px;
  strip.colors.background = background;
  strip.colors.mass = width_px * (background - wire);
  strip.colors.center = strip.colors.interior = 0.5 * (background + wire);
  return strip;
}

// Strips before 100 backgrounds that differ by some 20 grey levels, ten in each frame; `exposure`
// brightens frame by frame.
std::vector<ColoredStrip> Strips(double width_px, double too_wide, double exposure = 0) {
  std::vector<ColoredStrip> strips;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d background(110 + 30 * std::sin(1.0 * i), 100 + 30 * std::sin(2.3 * i),
                                     130 + 30 * std::sin(3.1 * i));
    const int frame = i / 10;
    const double gain = 1 + exposure * frame;
    strips.push_back(Strip(frame, width_px, too_wide, gain * background, gain * kWire));
  }
  return strips;
}

WireColor About(const Eigen::Vector3d& color) { return {color.normalized(), color.norm(), 15}; }

TEST(VanishingColorTest, IsTheWiresWhateverTheirWidthAndBlur) {
  for (const double too_wide : {0.8, 1.0, 1.3}) {
    const auto vanishing = FindVanishingColor(Strips(2.6, too_wide), About({80, 130, 90}));
    ASSERT_TRUE(vanishing);
    EXPECT_TRUE(vanishing->color.isApprox(kWire, 1e-6)) << vanishing->color.transpose();
    EXPECT_NEAR(vanishing->slope, 1 / too_wide, 1e-6);
    EXPECT_LT(vanishing->error, 1e-6);
  }
}

TEST(VanishingColorTest, ExposuresMayChangeFromFrameToFrame) {
  const auto vanishing = FindVanishingColor(Strips(2.6, 1, 0.1), About(kWire));
  ASSERT_TRUE(vanishing);
  EXPECT_NEAR(vanishing->slope, 1, 1e-6);
}

TEST(VanishingColorTest, StripsOfOtherThingsAreLeftOut) {
  std::vector<ColoredStrip> strips = Strips(2.6, 1);
  for (size_t i = 0; i < strips.size(); i += 7) strips[i].colors.mass = {20, -150, 90};
  const auto vanishing = FindVanishingColor(strips, About(kWire));
  ASSERT_TRUE(vanishing);
  EXPECT_TRUE(vanishing->color.isApprox(kWire, 1e-3)) << vanishing->color.transpose();
}

TEST(VanishingColorTest, NothingBeforeOneBackgroundOrOfFewStrips) {
  const std::vector<ColoredStrip> alike(60, Strip(0, 3, 1, {110, 120, 130}, kWire));
  EXPECT_FALSE(FindVanishingColor(alike, About(kWire)));
  const std::vector<ColoredStrip> strips = Strips(2.6, 1);
  EXPECT_FALSE(FindVanishingColor({strips.begin(), strips.begin() + 30}, About(kWire)));
  EXPECT_FALSE(FindVanishingColor({}, About(kWire)));
}

// What blur makes of the colour of narrow strips is shrunk towards the true one, wide ones keep
// theirs.
TEST(VanishingColorTest, NarrowStripsAreDrawnToIt) {
  const Eigen::Vector3d mixed(80, 128, 90);
  const WireColor of_narrow = DrawnToVanishing(About(mixed), Strips(2.6, 1.2));
  EXPECT_LT((of_narrow.shade * of_narrow.direction - kWire).norm(), 0.2 * (mixed - kWire).norm());
  const WireColor of_wide = DrawnToVanishing(About(mixed), Strips(12, 1));
  EXPECT_LT((of_wide.shade * of_wide.direction - mixed).norm(), 0.02 * (mixed - kWire).norm());
  EXPECT_EQ(of_wide.shade_spread, 15);
}

// Before backgrounds that hardly differ noise leaves the line's slope open.
TEST(VanishingColorTest, WhereBackgroundsTellLittleTheEstimateStays) {
  const Eigen::Vector3d mixed(70, 134, 80);
  for (const double contrast : {1.0, 0.1}) {
    std::vector<ColoredStrip> strips = Strips(4.2, 1);
    for (size_t i = 0; i < strips.size(); ++i) {
      Eigen::Vector3d& background = strips[i].colors.background;
      background =
          Eigen::Vector3d(110, 100, 130) + contrast * (background - Eigen::Vector3d(110, 100, 130));
      const double noise = 5 * std::sin(5.7 * static_cast<double>(i));
      strips[i].colors.mass = 4.2 * (background - kWire + Eigen::Vector3d(noise, 0, -noise));
    }
    const WireColor drawn = DrawnToVanishing(About(mixed), strips);
    const double from_estimate = (drawn.shade * drawn.direction - mixed).norm();
    EXPECT_EQ(from_estimate > 0.5 * (mixed - kWire).norm(), contrast == 1) << from_estimate;
  }
}

}  // namespace
}  // namespace curvefusion
