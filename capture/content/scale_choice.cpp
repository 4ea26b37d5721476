#include "capture/content/scale_choice.h"

#include <array>
#include <cmath>

namespace curvefusion {

namespace {

constexpr double kSnap = 1.06;   // measured: estimated factors are off by up to 4.5 %
constexpr double kMaxSpeed = 3;  // metres per second; chosen: hands that scan move at .1 to 1

struct CustomaryFactor {
  double factor;
  const char* unit;
};
constexpr std::array<CustomaryFactor, 6> kFactors = {{{0.001, "millimetres"},
                                                      {0.01, "centimetres"},
                                                      {0.1, "decimetres"},
                                                      {0.0254, "inches"},
                                                      {0.3048, "feet"},
                                                      {1000, "kilometres"}}};
// Units per metre of cameras and data sets: mm; TUM; RealSense D405 (.1 mm); L515 (.25 mm); ScanNet
// and Kinect files in mm, 1/2 mm and 10 um.
constexpr std::array<double, 6> kDepthScales = {1000, 5000, 10000, 4000, 2000, 100000};

bool IsNear(double a, double b) { return a < b * kSnap && b < a * kSnap; }

int DepthPlausibility(double depth) {
  if (depth >= 0.3 && depth <= 5) return 4;
  return depth >= 0.15 && depth <= 8 ? 2 : 0;
}

int SpeedPlausibility(double speed) { return speed <= kMaxSpeed ? 1 : 0; }

// The customary depth scale near `scale`, or 0.
double CustomaryDepthScale(double scale) {
  for (const double known : kDepthScales) {
    if (IsNear(scale, known)) return known;
  }
  return 0;
}

// The customary factor near `factor`, or 0.
double CustomaryFactorNear(double factor) {
  for (const CustomaryFactor& known : kFactors) {
    if (IsNear(factor, known.factor)) return known.factor;
  }
  return 0;
}

// Three digits are what an estimate is good for.
double Rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return std::round(value / unit) * unit;
}

}  // namespace

std::string UnitOfFactor(double factor) {
  for (const CustomaryFactor& known : kFactors) {
    if (factor == known.factor) return known.unit;
  }
  return "";
}

ScaleChoice ChooseScale(const ScaleEvidence& evidence) {
  const double depth_scale = CustomaryDepthScale(evidence.depth_scale * evidence.factor);
  const double factor = CustomaryFactorNear(evidence.factor);
  const int depth_plausibility = DepthPlausibility(evidence.median_depth / evidence.factor);
  const int factor_plausibility = DepthPlausibility(evidence.median_depth);
  const int depth_score =
      depth_plausibility + SpeedPlausibility(evidence.speed) + (depth_scale > 0 ? 2 : 0);
  const int factor_score = factor_plausibility +
                           SpeedPlausibility(evidence.speed * evidence.factor) +
                           (factor > 0 ? 2 : 0);
  const double best_scale =
      depth_scale > 0 ? depth_scale : Rounded(evidence.depth_scale * evidence.factor);
  const double best_factor = factor > 0 ? factor : Rounded(evidence.factor);
  if (depth_score > factor_score) return {true, best_scale, best_factor, factor_plausibility > 0};
  // Equal: trackers with one camera know no scale, depth cameras do.
  return {false, best_factor, best_scale, depth_plausibility > 0};
}

}  // namespace curvefusion
