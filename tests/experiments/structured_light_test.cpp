#include "experiments/simulation/structured_light.h"

#include <gtest/gtest.h>

#include "experiments/simulation/sensor_measurements.h"

namespace curvefusion {
namespace {

// Making a sensor costs a few tenths of a second: one for all.
const StructuredLightSensor& Kinect() {
  static const StructuredLightSensor sensor({}, 1);
  return sensor;
}

TEST(DotPattern, HasThePublishedDensityAndNoTouchingDots) {
  const DotPattern pattern(1);
  int dots = 0;
  int touching = 0;
  for (int row = 0; row < DotPattern::kHeight; ++row) {
    for (int column = 0; column < DotPattern::kWidth; ++column) {
      if (!pattern.HasDot(column, row)) continue;
      ++dots;
      for (int k = 0; k < 9; ++k) {
        if (k == 4) continue;
        touching += pattern.HasDot((column + k % 3 - 1 + DotPattern::kWidth) % DotPattern::kWidth,
                                   (row + k / 3 - 1 + DotPattern::kHeight) % DotPattern::kHeight);
      }
    }
  }
  EXPECT_EQ(dots, 3861);
  EXPECT_EQ(touching, 0);
}

TEST(DotPattern, EveryDotBringsItsLightOnce) {
  const DotPattern pattern(1);
  double light = 0;
  constexpr int kSteps = 4;
  for (int y = 0; y < DotPattern::kHeight * kSteps; ++y) {
    for (int x = 0; x < DotPattern::kWidth * kSteps; ++x) {
      light += pattern.Light(static_cast<double>(x) / kSteps, static_cast<double>(y) / kSteps,
                             [](uint64_t) { return 1.0; }) /
               (kSteps * kSteps);
    }
  }
  // A dot's Gaussian is cut off at 3 sigma, or where its 3x3 pixels end: 1 to 3 % less than all.
  EXPECT_LT(light, 3861 * 1.001);
  EXPECT_GT(light, 3861 * 0.97);
}

TEST(StructuredLight, RecallFallsWithDistance) {
  const double near = MeasureRecall(Kinect(), {.depth = 0.5}).recall;
  const double middle = MeasureRecall(Kinect(), {.depth = 0.7}).recall;
  const double far = MeasureRecall(Kinect(), {.depth = 0.9}).recall;
  EXPECT_GT(near, middle + 0.1);
  EXPECT_GT(middle, far + 0.1);
}

StructuredLightOptions Unfiltered() {
  StructuredLightOptions options;
  options.matching.drop_small_components = false;
  return options;
}

// The thresholds are choices; results must be published for others too, so what they move is fixed
// here, of the matcher alone: .59 with a seed at .55 and .25 without growing were measured, give or
// take 30 % for the two frames.
TEST(StructuredLight, RecallDependsOnTheMatchersThresholds) {
  StructuredLightOptions strict = Unfiltered();
  strict.matching.seed_correlation = 0.55;
  const double recall_strict = MeasureRecall(StructuredLightSensor(strict, 1), {}).recall;
  EXPECT_GT(recall_strict, 0.5);
  EXPECT_LT(recall_strict, 0.68);
  StructuredLightOptions no_growing = Unfiltered();
  no_growing.matching.grow_correlation = no_growing.matching.seed_correlation;
  const double recall_no_growing = MeasureRecall(StructuredLightSensor(no_growing, 1), {}).recall;
  EXPECT_GT(recall_no_growing, 0.17);
  EXPECT_LT(recall_no_growing, 0.33);
}

// Of a wire of 4 mm the matcher finds pieces; the filter keeps those of 220 pixels and more: .32
// instead of .68 were measured.
TEST(StructuredLight, TheFilterDropsShortPiecesOfThinWires) {
  const double filtered = MeasureRecall(Kinect(), {}).recall;
  EXPECT_LT(filtered, MeasureRecall(StructuredLightSensor(Unfiltered(), 1), {}).recall - 0.2);
  EXPECT_GT(filtered, 0.1);
}

TEST(StructuredLight, NothingIsMeasuredOutsideItsRange) {
  const RigidTransform still = RigidTransform::Identity();
  const DepthImage depth = Kinect().Measure(WallAt(0.3), {still, still, 0});
  // Of a surface too near, blocks match by chance: these depths are in range, and a few per cent.
  size_t valid = 0;
  for (size_t i = 0; i < depth.size(); ++i) {
    if (depth.data()[i] == 0) continue;
    ++valid;
    EXPECT_GE(depth.data()[i], 0.4f);
    EXPECT_LE(depth.data()[i], 4.0f);
  }
  EXPECT_LT(valid, depth.size() / 15);
}

TEST(StructuredLight, FramesDifferInNoiseAndRepeatExactly) {
  const RigidTransform still = RigidTransform::Identity();
  const IntensityImage first = Kinect().InfraredImage(WallAt(1), {still, still, 1});
  const IntensityImage again = Kinect().InfraredImage(WallAt(1), {still, still, 1});
  const IntensityImage other = Kinect().InfraredImage(WallAt(1), {still, still, 2});
  EXPECT_TRUE(std::equal(first.data(), first.data() + first.size(), again.data()));
  EXPECT_FALSE(std::equal(first.data(), first.data() + first.size(), other.data()));
}

}  // namespace
}  // namespace curvefusion
