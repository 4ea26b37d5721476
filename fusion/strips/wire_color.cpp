#include "fusion/strips/wire_color.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: how backgrounds vary, and shades at the least.
constexpr double kBackgroundNoise = 1.3;  // grey levels, mean over a window: it is not straight
constexpr double kWindowMarginPx = 5;     // of background in the window of a strip
constexpr double kMinShadeSpread = 5;     // grey levels
// Chosen: more than twice that of luma, as JPEG stores chroma at half resolution; looked for
// in small steps, where two halves of 20 strips differ enough in width.
constexpr double kMaxChromaBlurPx = 2.5;
constexpr double kBlurStepPx = 0.05;
constexpr size_t kMinCalibrationStrips = 40;
constexpr double kMinWidthRatio = 1.15;  // between the wide and the narrow half, to calibrate

// What is left of a strip's contrast at its centre after Gaussian blur.
double CenterGain(double width_px, double blur_px) {
  return std::erf(width_px / (2 * M_SQRT2 * blur_px));
}

// And on average over its width, to first order.
double InteriorGain(double width_px, double blur_px) {
  return std::max(0.3, 1 - 0.798 * blur_px / width_px);
}

double Luma(const Eigen::Vector3d& rgb) { return rgb.dot(Eigen::Vector3d(0.299, 0.587, 0.114)); }

// Amplifies luma and chroma of a colour difference.
Eigen::Vector3d Amplify(const Eigen::Vector3d& difference, double luma_gain, double chroma_gain) {
  const Eigen::Vector3d luma = Eigen::Vector3d::Constant(Luma(difference));
  return luma * luma_gain + (difference - luma) * chroma_gain;
}

// Channel by channel, made unit.
Eigen::Vector3d MedianDirection(const std::vector<Eigen::Vector3d>& colors) {
  Eigen::Vector3d median;
  std::vector<double> values(colors.size());
  for (int k = 0; k < 3; ++k) {
    for (size_t i = 0; i < colors.size(); ++i) {
      values[i] = colors[i][k] / std::max(1.0, colors[i].norm());
    }
    median[k] = std::max(0.0, Median(values));
  }
  if (median.norm() <= 0) return Eigen::Vector3d::Constant(1 / std::sqrt(3.0));
  return median.normalized();
}

Eigen::Vector3d MedianCenterDirection(const std::vector<ColoredStrip>& strips, size_t begin,
                                      size_t end, const ImageBlur& blur) {
  std::vector<Eigen::Vector3d> colors;
  for (size_t i = begin; i < end; ++i) colors.push_back(UnblurredCenter(strips[i], blur));
  return MedianDirection(colors);
}

}  // namespace

Eigen::Vector3d UnblurredCenter(const ColoredStrip& strip, const ImageBlur& blur) {
  const Eigen::Vector3d difference = strip.colors.center - strip.colors.background;
  return strip.colors.background + Amplify(difference, 1 / CenterGain(strip.width_px, blur.luma_px),
                                           1 / CenterGain(strip.width_px, blur.chroma_px));
}

double CalibrateChromaBlur(const std::vector<ColoredStrip>& strips, const ImageBlur& blur) {
  if (strips.size() < kMinCalibrationStrips) return blur.chroma_px;
  std::vector<ColoredStrip> sorted = strips;
  std::stable_sort(sorted.begin(), sorted.end(), [](const ColoredStrip& a, const ColoredStrip& b) {
    return a.width_px < b.width_px;
  });
  const size_t n = sorted.size();
  if (sorted[3 * n / 4].width_px < kMinWidthRatio * sorted[n / 4].width_px) return blur.chroma_px;
  double best = blur.chroma_px;
  double least = 1;
  for (double chroma = blur.luma_px; chroma <= kMaxChromaBlurPx; chroma += kBlurStepPx) {
    const ImageBlur trial{blur.luma_px, chroma};
    const double difference = (MedianCenterDirection(sorted, 0, n / 2, trial) -
                               MedianCenterDirection(sorted, n / 2, n, trial))
                                  .norm();
    if (difference >= least) continue;
    least = difference;
    best = chroma;
  }
  return best;
}

WireColor EstimateWireColor(const std::vector<ColoredStrip>& strips, const ImageBlur& blur) {
  WireColor color;
  color.direction = MedianCenterDirection(strips, 0, strips.size(), blur);
  std::vector<double> shades;
  for (const ColoredStrip& strip : strips) {
    const Eigen::Vector3d difference = strip.colors.interior - strip.colors.background;
    const Eigen::Vector3d interior =
        strip.colors.background + Amplify(difference,
                                          1 / InteriorGain(strip.width_px, blur.luma_px),
                                          1 / InteriorGain(strip.width_px, blur.chroma_px));
    shades.push_back(color.direction.dot(interior));
  }
  color.shade = std::max(0.0, Median(shades));
  for (double& shade : shades) shade -= color.shade;
  color.shade_spread = std::max(kMinShadeSpread, RobustDeviation(std::move(shades)));
  return color;
}

Eigen::Matrix3d MassCovariance(double width_px, const WireColor& color) {
  const double spread = color.shade_spread * width_px;
  const double noise = kBackgroundNoise * (width_px + kWindowMarginPx);
  return noise * noise * Eigen::Matrix3d::Identity() +
         spread * spread * color.direction * color.direction.transpose();
}

SolvedWidth SolveWidth(const ColoredStrip& strip, const WireColor& color) {
  const Eigen::Vector3d contrast = strip.colors.background - color.shade * color.direction;
  const Eigen::Matrix3d information = MassCovariance(strip.width_px, color).inverse();
  SolvedWidth solved;
  solved.weights = information * contrast;
  const double precision = contrast.dot(solved.weights);
  solved.width_px = solved.weights.dot(strip.colors.mass) / precision;
  solved.significance = solved.width_px * std::sqrt(precision);
  const Eigen::Vector3d rest = strip.colors.mass - solved.width_px * contrast;
  solved.misfit = std::sqrt(std::max(0.0, rest.dot(information * rest)));
  return solved;
}

}  // namespace curvefusion
