#include "fusion/strips/strip_tracking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvefusion {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

// Upright strips whose edges cover pixels in part, at `centre_of(v)`.
template <class Centre>
void DrawWire(const Centre& centre_of, double width_px, PosteriorImage& image) {
  for (int v = 0; v < image.height(); ++v) {
    const double left = centre_of(v) - 0.5 * width_px;
    for (int u = 0; u < image.width(); ++u) {
      const double cover = std::min(u + 0.5, left + width_px) - std::max(u - 0.5, left);
      const double value = 255 * std::clamp(cover, 0.0, 1.0);
      image(u, v) = std::max(image(u, v), static_cast<uint8_t>(std::lround(value)));
    }
  }
}

// A curve expected at u = 80, every 3 px; a pixel is a millimetre, the wire 6 mm thick.
std::vector<ProjectedSample> Expected() {
  std::vector<ProjectedSample> samples;
  for (int v = 15; v < kHeight - 15; v += 3) {
    ProjectedSample sample;
    sample.index = static_cast<int>(samples.size());
    sample.pixel = Vec2(80, v);
    sample.tangent = Vec2(0, 1);
    sample.normal = Vec2(-1, 0);
    sample.metres_per_px = 0.001;
    sample.clearance_px = 40;
    samples.push_back(sample);
  }
  return samples;
}

std::vector<double> Radii() { return std::vector<double>(Expected().size(), 0.003); }

TEST(TrackStripsTest, FindsTheCentreToATenthOfAPixel) {
  PosteriorImage image(kWidth, kHeight, 0);
  const auto centre = [](int v) { return 84.3 + 2 * std::sin(v / 20.0); };
  DrawWire(centre, 6, image);
  for (const TrackedStrip& strip : TrackStrips(image, Expected(), Radii(), 10)) {
    const double v = Expected()[strip.sample].pixel.y();
    EXPECT_TRUE(strip.accepted);
    // .1 px: whole pixels are covered in steps of 1/255, rows are a pixel high
    EXPECT_NEAR(80 - strip.offset_px, centre(static_cast<int>(v)), 0.1);
    EXPECT_GT(strip.score, 0.9);
  }
}

TEST(TrackStripsTest, NothingIsAcceptedWithoutAStrip) {
  for (const uint8_t flat : {0, 128, 255}) {
    for (const TrackedStrip& strip :
         TrackStrips(PosteriorImage(kWidth, kHeight, flat), Expected(), Radii(), 10)) {
      EXPECT_FALSE(strip.accepted);
    }
  }
}

TEST(TrackStripsTest, AnEdgeIsNoStrip) {
  PosteriorImage image(kWidth, kHeight, 0);
  DrawWire([](int) { return 120; }, 80, image);  // bright from 80 to the right
  for (const TrackedStrip& strip : TrackStrips(image, Expected(), Radii(), 10)) {
    EXPECT_FALSE(strip.accepted);
  }
}

TEST(TrackStripsTest, TwoStripsAreNoAnswer) {
  PosteriorImage image(kWidth, kHeight, 0);
  DrawWire([](int) { return 73; }, 6, image);
  DrawWire([](int) { return 87; }, 6, image);
  for (const TrackedStrip& strip : TrackStrips(image, Expected(), Radii(), 10)) {
    EXPECT_FALSE(strip.accepted);
  }
}

TEST(TrackStripsTest, AnotherCurveNearbyIsNotMeasured) {
  PosteriorImage image(kWidth, kHeight, 0);
  DrawWire([](int) { return 80; }, 6, image);
  std::vector<ProjectedSample> samples = Expected();
  for (ProjectedSample& sample : samples) sample.clearance_px = 7;  // below .85 x 6 + 2
  for (const TrackedStrip& strip : TrackStrips(image, samples, Radii(), 10)) {
    EXPECT_FALSE(strip.accepted);
  }
}

// A blot beside the wire in a few rows is brighter than the wire.
TEST(TrackStripsTest, ABlotDoesNotLureThePathAway) {
  PosteriorImage image(kWidth, kHeight, 0);
  DrawWire([](int) { return 80; }, 6, image);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) image(u, v) = static_cast<uint8_t>(image(u, v) * 0.8);
  }
  for (int v = 57; v < 62; ++v) {
    for (int u = 68; u < 74; ++u) image(u, v) = 255;
  }
  for (const TrackedStrip& strip : TrackStrips(image, Expected(), Radii(), 12)) {
    EXPECT_NEAR(strip.offset_px, 0, 0.4);  // next to it the blot counts as background
  }
}

TEST(TrackStripsTest, AWireOfARowIsNotTakenForItsNeighbour) {
  // Wires 12 px apart, this one less clear than the next: that is 10 px off, nearer to its own
  // curve than to this.
  PosteriorImage image(kWidth, kHeight, 0);
  DrawWire([](int) { return 78; }, 6, image);
  for (size_t i = 0; i < image.size(); ++i) image.data()[i] /= 2;
  DrawWire([](int) { return 90; }, 6, image);
  std::vector<ProjectedSample> samples = Expected();
  for (ProjectedSample& sample : samples) sample.clearance_px = 12;
  for (const TrackedStrip& strip : TrackStrips(image, samples, Radii(), 14)) {
    EXPECT_TRUE(strip.accepted);
    EXPECT_NEAR(80 - strip.offset_px, 78, 0.3);  // half a step of the centres, and rounding
  }
}

// The image with its border repeated `margin` times on every side.
PosteriorImage WithRepeatedBorder(const PosteriorImage& image, int margin) {
  PosteriorImage larger(image.width() + 2 * margin, image.height() + 2 * margin);
  for (int v = 0; v < larger.height(); ++v) {
    for (int u = 0; u < larger.width(); ++u) {
      larger(u, v) = image(std::clamp(u - margin, 0, image.width() - 1),
                           std::clamp(v - margin, 0, image.height() - 1));
    }
  }
  return larger;
}

TEST(TrackStripsTest, BeyondTheImageItsBorderGoesOn) {
  constexpr int kMargin = 40;
  for (const double u : {1.0, kWidth - 2.0}) {
    PosteriorImage image(kWidth, kHeight, 0);
    const auto centre = [&](int v) { return u + 4 * std::sin(v / 9.0); };
    DrawWire(centre, 6, image);
    std::vector<ProjectedSample> samples = Expected();
    for (ProjectedSample& sample : samples) {
      sample.pixel.x() = u;
      sample.normal = Vec2(-1, 0.4).normalized();
    }
    samples.front().pixel.y() = 0;
    samples.back().pixel.y() = kHeight - 1;
    const auto at_border = TrackStrips(image, samples, Radii(), 10);
    for (ProjectedSample& sample : samples) sample.pixel += Vec2(kMargin, kMargin);
    const auto inside = TrackStrips(WithRepeatedBorder(image, kMargin), samples, Radii(), 10);
    ASSERT_EQ(at_border.size(), inside.size());
    int accepted = 0;
    for (size_t i = 0; i < inside.size(); ++i) {
      EXPECT_NEAR(at_border[i].offset_px, inside[i].offset_px, 1e-4);  // places rounded elsewhere
      EXPECT_NEAR(at_border[i].score, inside[i].score, 1e-5);
      EXPECT_EQ(at_border[i].accepted, inside[i].accepted);
      accepted += inside[i].accepted;
    }
    EXPECT_GT(accepted, 5);
  }
}

TEST(TrackStripsTest, NoSamplesNoStrips) {
  EXPECT_TRUE(TrackStrips(PosteriorImage(kWidth, kHeight, 0), {}, {}, 10).empty());
}

}  // namespace
}  // namespace curvefusion
