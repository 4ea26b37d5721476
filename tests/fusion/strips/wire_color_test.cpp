#include "fusion/strips/wire_color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvefusion {
namespace {

const Eigen::Vector3d kGreen = Eigen::Vector3d(40, 110, 50).normalized();

double Luma(const Eigen::Vector3d& rgb) { return rgb.dot(Eigen::Vector3d(0.299, 0.587, 0.114)); }

// What MeasureStrip finds of an evenly coloured strip under a blur.
ColoredStrip Strip(double width_px, const Eigen::Vector3d& color, const Eigen::Vector3d& background,
                   const ImageBlur& blur) {
  const Eigen::Vector3d difference = color - background;
  const Eigen::Vector3d luma = Eigen::Vector3d::Constant(Luma(difference));
  const auto gain = [width_px](double s) { return std::erf(width_px / (2 * M_SQRT2 * s)); };
  ColoredStrip strip;
  strip.width_px = width_px;
  strip.colors.background = background;
  strip.colors.mass = -width_px * difference;
  strip.colors.center =
      background + gain(blur.luma_px) * luma + gain(blur.chroma_px) * (difference - luma);
  strip.colors.interior = strip.colors.center;
  return strip;
}

std::vector<ColoredStrip> StripsOfManyWidths(const ImageBlur& blur) {
  std::vector<ColoredStrip> strips;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d background(110 + i % 7, 120 - i % 5, 125);
    strips.push_back(Strip(3 + 0.08 * i, (100 + i % 11) * kGreen, background, blur));
  }
  return strips;
}

TEST(WireColorTest, UnblurringUndoesTheBlur) {
  const ImageBlur blur{0.95, 1.4};
  const ColoredStrip strip = Strip(4, 120 * kGreen, {110, 120, 130}, blur);
  EXPECT_TRUE(UnblurredCenter(strip, blur).isApprox(120 * kGreen, 1e-9));
}

TEST(WireColorTest, ChromaBlurIsFoundFromStripsOfSeveralWidths) {
  for (const double chroma : {1.1, 1.4, 1.9}) {
    const ImageBlur truth{0.95, chroma};
    // grid of 0.05 px
    EXPECT_NEAR(CalibrateChromaBlur(StripsOfManyWidths(truth), {0.95, 1.4}), chroma, 0.051);
  }
}

TEST(WireColorTest, ChromaBlurIsKeptWhereStripsCannotTell) {
  const std::vector<ColoredStrip> equal(60, Strip(4, 120 * kGreen, {110, 120, 130}, {0.95, 1.9}));
  EXPECT_EQ(CalibrateChromaBlur(equal, {0.95, 1.4}), 1.4);
  EXPECT_EQ(CalibrateChromaBlur({}, {0.95, 1.4}), 1.4);
}

TEST(WireColorTest, TheColourMostStripsAgreeOn) {
  const ImageBlur blur{0.95, 1.4};
  std::vector<ColoredStrip> strips = StripsOfManyWidths(blur);
  for (int i = 0; i < 15; ++i) {
    strips.push_back(Strip(4, {200, 30, 30}, {110, 120, 130}, blur));  // another thing
  }
  const WireColor color = EstimateWireColor(strips, blur);
  EXPECT_LT(color.direction.cross(kGreen).norm(), 0.02);  // medians move a little with outliers
}

TEST(WireColorTest, WidthsOfShadedStripsAreRight) {
  const WireColor color{kGreen, 110, 15};
  for (const double shade : {90.0, 110.0, 130.0}) {
    const ColoredStrip strip = Strip(4.4, shade * kGreen, {120, 115, 130}, {});
    // The shade is looked for near 110, which draws by some percent.
    EXPECT_NEAR(SolveWidth(strip, color).width_px, 4.4, 0.03 * 4.4) << shade;
    EXPECT_LT(SolveWidth(strip, color).misfit, 2) << shade;
  }
}

// A black wire before grey: nothing but the usual shade tells its colour.
TEST(WireColorTest, NeutralWiresRelyOnTheirUsualShade) {
  const Eigen::Vector3d grey = Eigen::Vector3d::Constant(1 / std::sqrt(3.0));
  const ColoredStrip strip = Strip(12, 40 * grey, {120, 120, 120}, {});
  EXPECT_NEAR(SolveWidth(strip, {grey, 40, 5}).width_px, 12, 1e-6);
  EXPECT_GT(SolveWidth(strip, {grey, 40, 5}).significance, 10);
}

TEST(WireColorTest, AStripOfAnotherColourHasAMisfit) {
  const ColoredStrip strip = Strip(5, {200, 30, 30}, {120, 115, 130}, {});
  EXPECT_GT(SolveWidth(strip, {kGreen, 110, 15}).misfit, 5);
}

}  // namespace
}  // namespace curvefusion
