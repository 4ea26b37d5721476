#include "capture/color_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "capture/frame_stream.h"
#include "capture/sequence.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kMiddle = 128;  // of the scale
constexpr int kFrames = 12;      // looked at; chosen
constexpr int kStep = 3;         // pixels; chosen: every third one of every third row
constexpr double kShare = 0.01;  // of the pixels may lie beyond either end of the range; chosen
// Grey levels. Measured: the shared scans, made with usual light, have 80 to 94, real recordings
// 160 to 250.
constexpr double kUsualRange = 80;
// Grey levels; chosen: what is taken for noise where strips are looked for.
constexpr double kNoise = 3;
constexpr double kStepVariance = 1.0 / 12;  // of rounding to whole levels; derived

struct PixelSample {
  std::vector<double> levels;
  std::vector<double> curvature;  // of the levels, as large as their noise where they run straight
};

int Grey(const Rgb& pixel) { return pixel[0] + pixel[1] + pixel[2]; }

PixelSample SampleOf(const ColorImage& image) {
  PixelSample sample;
  for (int v = 1; v + 1 < image.height(); v += kStep) {
    for (int u = 1; u + 1 < image.width(); u += kStep) {
      const int here = Grey(image(u, v));
      int beside = 0;
      for (const auto& [du, dv] : kPixelsBeside) beside += Grey(image(u + du, v + dv));
      sample.levels.push_back(here / 3.0);
      // Four times one pixel less four others has 20 times the variance of one.
      sample.curvature.push_back((4 * here - beside) / (3 * std::sqrt(20.0)));
    }
  }
  return sample;
}

PixelSample SampleOf(const Sequence& sequence) {
  PixelSample all;
  for (const PixelSample& sample :
       OfStoredColors(sequence, kFrames, [](const ColorImage& image) { return SampleOf(image); })) {
    all.levels.insert(all.levels.end(), sample.levels.begin(), sample.levels.end());
    all.curvature.insert(all.curvature.end(), sample.curvature.begin(), sample.curvature.end());
  }
  return all;
}

}  // namespace

ColorLevels MeasureColorLevels(const Sequence& sequence) {
  const PixelSample sample = SampleOf(sequence);
  if (sample.levels.empty()) return {};
  const double low = Quantile(sample.levels, kShare);
  const double high = Quantile(sample.levels, 1 - kShare);
  const double noise = std::hypot(RobustDeviation(sample.curvature), std::sqrt(kStepVariance));
  if (high - low >= kUsualRange || high == low) return {};
  return {std::max(1.0, std::min(kUsualRange / (high - low), kNoise / noise)), (low + high) / 2};
}

void ApplyLevels(const ColorLevels& levels, ColorImage& image) {
  if (levels.gain == 1) return;
  std::array<uint8_t, 256> stretched;
  for (int level = 0; level < 256; ++level) {
    const double value = kMiddle + levels.gain * (level - levels.middle);
    stretched[static_cast<size_t>(level)] =
        static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  }
  for (int v = 0; v < image.height(); ++v) {
    for (Rgb* pixel = image.row(v); pixel != image.row(v) + image.width(); ++pixel) {
      for (uint8_t& channel : *pixel) channel = stretched[channel];
    }
  }
}

}  // namespace curvefusion
