#include "capture/content/colour_survey.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "capture/content/shrunk_grey.h"
#include "capture/frame_stream.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr int kWorkingWidth = 320;
constexpr int kBright = 250;  // grey levels; chosen: next to the end of the scale
// Measured: images of one grey with noise of 1.5 levels have .8; the least of all scans is 15.
constexpr double kFeatureless = 3;
// Measured: grey images have 0 (JPEG: below 1), the aims scan, nearly without colours, 6.7,
// others 23.
constexpr double kGreyChroma = 2;
// Sharpness compares differences over these many pixels where the wider ones are strong.
constexpr int kFine = 2;
constexpr int kCoarse = 6;
constexpr double kStrongQuantile = 0.97;  // chosen: some hundred pixels
constexpr float kMinStrong = 64;          // squared grey levels; chosen: weaker edges are texture
// Measured on eleven scans: no good one has a frame below .6 of its sharpest tenth, fr1_rpy, whose
// camera is shaken, a quarter of them.
constexpr double kBlurred = 0.6;

struct FrameFigures {
  bool is_read = false;
  double brightness = 0, bright_share = 0, contrast = 0, chroma = 0, sharpness = 0;
};

double StandardDeviation(const Image<float>& image) {
  double sum = 0, squares = 0;
  for (size_t i = 0; i < image.size(); ++i) {
    sum += image.data()[i];
    squares += static_cast<double>(image.data()[i]) * image.data()[i];
  }
  const double n = std::max(1.0, static_cast<double>(image.size()));
  return std::sqrt(std::max(0.0, squares / n - sum / n * sum / n));
}

double MeanChroma(const ColorImage& image) {
  int64_t sum = 0;
  for (size_t i = 0; i < image.size(); ++i) {
    const Rgb& c = image.data()[i];
    const auto [low, high] = std::minmax({c[0], c[1], c[2]});
    sum += high - low;
  }
  return static_cast<double>(sum) / std::max(1.0, static_cast<double>(image.size()));
}

// Squared differences over `step` pixels in one direction, of places kCoarse from the border.
float Difference(const Image<float>& grey, int u, int v, int du, int dv, int step) {
  const float d = grey(u + du * step, v + dv * step) - grey(u, v);
  return d * d;
}

// The ratio of fine to coarse differences in the direction in which it is least: motion blurs one.
double Sharpness(const Image<float>& grey) {
  double least = 1;
  for (const auto& [du, dv] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
    std::vector<float> coarse;
    for (int v = kCoarse; v + kCoarse < grey.height(); ++v) {
      for (int u = 0; u + kCoarse < grey.width(); ++u) {
        coarse.push_back(Difference(grey, u, v, du, dv, kCoarse));
      }
    }
    if (coarse.empty()) return 0;
    std::vector<float> sorted = coarse;
    const auto place =
        sorted.begin() +
        static_cast<ptrdiff_t>(kStrongQuantile * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), place, sorted.end());
    const float strong = std::max(kMinStrong, *place);
    double fine_sum = 0, coarse_sum = 0;
    size_t i = 0;
    for (int v = kCoarse; v + kCoarse < grey.height(); ++v) {
      for (int u = 0; u + kCoarse < grey.width(); ++u, ++i) {
        if (coarse[i] < strong) continue;
        coarse_sum += coarse[i];
        fine_sum += Difference(grey, u, v, du, dv, kFine);
      }
    }
    if (coarse_sum == 0) return 0;
    least = std::min(least, fine_sum / coarse_sum);
  }
  return least;
}

double MedianGrey(const Image<float>& grey) {
  std::vector<double> values(grey.data(), grey.data() + grey.size());
  return Quantile(std::move(values), 0.5);
}

FrameFigures LookAt(const ColorImage& image) {
  const Image<float> grey = ShrunkGrey(image, DivisorForWidth(image.width(), kWorkingWidth));
  FrameFigures figures;
  figures.is_read = !grey.empty();
  if (grey.empty()) return figures;
  figures.brightness = MedianGrey(grey);
  const auto bright = std::count_if(grey.data(), grey.data() + grey.size(),
                                    [](float value) { return value >= kBright; });
  figures.bright_share = static_cast<double>(bright) / static_cast<double>(grey.size());
  figures.contrast = StandardDeviation(grey);
  figures.chroma = MeanChroma(image);
  figures.sharpness = Sharpness(grey);
  return figures;
}

template <class Member>
std::vector<double> All(const std::vector<FrameFigures>& frames, Member member) {
  std::vector<double> values;
  for (const FrameFigures& frame : frames) values.push_back(frame.*member);
  return values;
}

template <class Member>
double MedianOf(const std::vector<FrameFigures>& frames, Member member) {
  return Quantile(All(frames, member), 0.5);
}

}  // namespace

bool ColourSurvey::IsFeatureless() const { return frames > 0 && contrast < kFeatureless; }

bool ColourSurvey::IsGrey() const { return frames > 0 && !IsFeatureless() && chroma < kGreyChroma; }

ColourSurvey SurveyColour(const Sequence& sequence, int max_frames) {
  std::vector<FrameFigures> figures = OfStoredColors(sequence, max_frames, LookAt);
  std::erase_if(figures, [](const FrameFigures& frame) { return !frame.is_read; });
  ColourSurvey survey;
  survey.frames = static_cast<int>(figures.size());
  if (figures.empty()) return survey;
  survey.brightness = MedianOf(figures, &FrameFigures::brightness);
  survey.bright_share = MedianOf(figures, &FrameFigures::bright_share);
  survey.contrast = MedianOf(figures, &FrameFigures::contrast);
  survey.chroma = MedianOf(figures, &FrameFigures::chroma);
  survey.sharpness = MedianOf(figures, &FrameFigures::sharpness);
  const double sharp = Quantile(All(figures, &FrameFigures::sharpness), 0.9);
  const auto blurred = std::count_if(figures.begin(), figures.end(), [&](const FrameFigures& f) {
    return f.sharpness < kBlurred * sharp;
  });
  survey.blurred_share = static_cast<double>(blurred) / static_cast<double>(figures.size());
  return survey;
}

}  // namespace curvefusion
