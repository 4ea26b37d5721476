#include "apps/run_account.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvefusion {
namespace {

using testing::HasSubstr;

// What a grey scan of a wire object gives.
Funnel GreyFunnel() {
  Funnel funnel;
  PointFunnel& points = funnel.points;
  points.frames = 150;
  points.depth_pixels = 30'000'000;
  points.thin_pixels = points.gated_pixels = 500'000;
  points.merged_points = 34'063;
  points.too_few_frames = 40;
  points.unverified = 34'017;
  points.small_clusters = 6;
  points.chroma = 0.5;
  return funnel;
}

TEST(WhyNothing, NamesTheRuleThatTookMost) {
  Funnel funnel = GreyFunnel();
  EXPECT_EQ(WhyNothing(funnel),
            "34,017 of 34,063 candidates fell to the colour check; the images are nearly grey");
  funnel.points.chroma = 30;
  EXPECT_THAT(WhyNothing(funnel), HasSubstr("no edges in the colour images"));
  std::swap(funnel.points.unverified, funnel.points.too_few_frames);
  EXPECT_THAT(WhyNothing(funnel), HasSubstr("34,017 of 34,063 candidates were seen in too few"));
}

TEST(WhyNothing, FollowsTheRunFromItsBeginning) {
  Funnel funnel;
  EXPECT_THAT(WhyNothing(funnel), HasSubstr("no depth"));
  funnel.points.depth_pixels = 1'234'567;
  EXPECT_THAT(WhyNothing(funnel), HasSubstr("none of 1,234,567 depth pixels"));
  funnel.points.thin_pixels = 100;
  EXPECT_THAT(WhyNothing(funnel), HasSubstr("all of 100 pixels"));
  funnel.points.gated_pixels = funnel.points.merged_points = funnel.points.points = 50;
  EXPECT_THAT(WhyNothing(funnel), HasSubstr("along no curve"));
  funnel.curves.contracted = 2;
  funnel.curves.unproven.thick = 1.5;
  funnel.curves.looked_past = 0.5;
  EXPECT_THAT(WhyNothing(funnel), HasSubstr("1.50 of 2.00 m of curve were thicker"));
}

TEST(RunAccount, TheTerminalIsToldWhatWasLeftOut) {
  UnprovenLengths lengths;
  EXPECT_EQ(UncertainLine(lengths), "");
  lengths.surface = 6.04;
  lengths.thick = 1.74;
  lengths.unproven = 0.001;  // too little to be shown
  EXPECT_EQ(UncertainLine(lengths),
            "  left out  7.78 m that are no proven wires: 6.04 m edges of surfaces, 1.74 m too "
            "thick\n");
}

TEST(RunAccount, TheTerminalIsToldTheEvidence) {
  Trust trust;
  trust.measured_share = 0.5;
  trust.depth_share = 0.75;
  trust.colour_share = 1;
  trust.adjusted = true;
  trust.residual_before_px = 0.5;
  trust.residual_px = 0.09;
  const std::string lines = TrustLines(trust);
  EXPECT_THAT(lines, HasSubstr("measured on 50 % of the length, seen in depth on 75 %, in colour "
                               "on 100 %"));
  EXPECT_THAT(lines, HasSubstr("0.09 px beside their strips in colour (0.50 before)"));
}

}  // namespace
}  // namespace curvefusion
