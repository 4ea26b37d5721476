#include "fusion/strips/vanishing_color.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen on training scans (docs/lab_notebook.md#the-backgrounds-before-which-wires-vanish), as all
// below.
constexpr size_t kMinStrips = 40;   // for a line
constexpr double kMinVariance = 1;  // grey levels squared, of backgrounds within images
constexpr int kRounds = 4;          // of leaving out
constexpr double kOffLine = 2.5;    // times the median distance to the line
// Errors of the contrast of wire and background, relative. That of the vanishing colour where
// wires mirror a tenth of their surroundings, besides so many standard errors of the slope, as
// strips err together. Chosen: with .03 instead of .1 a cage's diameters are better, a hanger's
// worse:
constexpr double kMirrored = 0.1;
constexpr double kErrors = 3;
// That of a colour estimated from blurred strips: so large where the widest tenth of them are so
// narrow, and falling e-fold with so much more width to what it is for wide ones. Chosen likewise:
constexpr double kNarrowError = 0.3;
constexpr double kNarrowPx = 4.3;
constexpr double kFallPx = 0.45;
constexpr double kWideError = 0.01;

// What a strip tells of the line y = slope (x - color).
struct Observation {
  int frame = 0;
  Eigen::Vector3d x;       // background
  Eigen::Vector3d y;       // taken away per pixel of width
  Eigen::Matrix3d weight;  // inverse covariance of y
};

std::vector<Observation> Observe(const std::vector<ColoredStrip>& strips, const WireColor& about) {
  std::vector<Observation> observations;
  for (const ColoredStrip& strip : strips) {
    const double width = strip.width_px;
    observations.push_back({strip.frame, strip.colors.background, strip.colors.mass / width,
                            width * width * MassCovariance(width, about).inverse()});
  }
  return observations;
}

// Weighted means.
struct Means {
  Eigen::Matrix3d weight = Eigen::Matrix3d::Zero();
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Vector3d y = Eigen::Vector3d::Zero();

  void Add(const Observation& of) {
    weight += of.weight;
    x += of.weight * of.x;
    y += of.weight * of.y;
  }
  void Finish() {
    const Eigen::Matrix3d inverse = weight.inverse();
    x = inverse * x;
    y = inverse * y;
  }
};

// The line through the observations that are used, and the mean of all and of each frame.
struct Line {
  double slope = 0;
  double information = 0;  // on the slope
  double variance = 0;     // of backgrounds within frames, of all colours together
  Means all;
  std::map<int, Means> of_frame;
};

Line FitLine(const std::vector<Observation>& observations, const std::vector<char>& is_used) {
  Line line;
  for (size_t i = 0; i < observations.size(); ++i) {
    if (!is_used[i]) continue;
    line.of_frame[observations[i].frame].Add(observations[i]);
    line.all.Add(observations[i]);
  }
  line.all.Finish();
  for (auto& [frame, means] : line.of_frame) means.Finish();
  double product = 0;
  for (size_t i = 0; i < observations.size(); ++i) {
    if (!is_used[i]) continue;
    const Observation& of = observations[i];
    const Means& means = line.of_frame.at(of.frame);
    const Eigen::Vector3d x = of.x - means.x;
    line.variance += x.squaredNorm();
    line.information += x.dot(of.weight * x);
    product += x.dot(of.weight * (of.y - means.y));
  }
  line.variance /= static_cast<double>(std::count(is_used.begin(), is_used.end(), 1));
  line.slope = line.information > 0 ? product / line.information : 0;
  return line;
}

double SquaredDistance(const Observation& of, const Line& line) {
  const auto means = line.of_frame.find(of.frame);
  if (means == line.of_frame.end()) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d off = of.y - means->second.y - line.slope * (of.x - means->second.x);
  return off.dot(of.weight * off);
}

double ErrorOfEstimate(const std::vector<ColoredStrip>& strips) {
  std::vector<double> widths;
  for (const ColoredStrip& strip : strips) widths.push_back(strip.width_px);
  const double widest_tenth = Quantile(std::move(widths), 0.9);
  return kNarrowError * std::exp((kNarrowPx - widest_tenth) / kFallPx) + kWideError;
}

}  // namespace

std::optional<VanishingColor> FindVanishingColor(const std::vector<ColoredStrip>& strips,
                                                 const WireColor& about) {
  if (strips.size() < kMinStrips) return std::nullopt;
  const std::vector<Observation> observations = Observe(strips, about);
  std::vector<char> is_used(observations.size(), 1);
  VanishingColor vanishing;
  for (int round = 0; round < kRounds; ++round) {
    const Line line = FitLine(observations, is_used);
    if (line.slope <= 0 || line.variance < kMinVariance) return std::nullopt;
    double sum = 0;
    std::vector<double> squares;
    for (size_t i = 0; i < observations.size(); ++i) {
      squares.push_back(SquaredDistance(observations[i], line));
      if (is_used[i]) sum += squares.back();
    }
    const auto used = static_cast<double>(std::count(is_used.begin(), is_used.end(), 1));
    vanishing = {line.all.x - line.all.y / line.slope, line.slope,
                 std::sqrt(sum / (3 * used) / line.information)};
    const double limit = kOffLine * kOffLine * Median(squares);
    for (size_t i = 0; i < squares.size(); ++i) is_used[i] = squares[i] <= limit;
  }
  return vanishing;
}

WireColor DrawnToVanishing(const WireColor& estimated, const std::vector<ColoredStrip>& strips) {
  const auto vanishing = FindVanishingColor(strips, estimated);
  if (!vanishing) return estimated;
  const double error_of_vanishing = kMirrored + kErrors * vanishing->error / vanishing->slope;
  const double share = 1 / (1 + std::pow(error_of_vanishing / ErrorOfEstimate(strips), 2));
  const Eigen::Vector3d color =
      (1 - share) * estimated.shade * estimated.direction + share * vanishing->color.cwiseMax(0.0);
  WireColor drawn = estimated;
  drawn.shade = color.norm();
  if (drawn.shade > 0) drawn.direction = color / drawn.shade;
  return drawn;
}

}  // namespace curvefusion
