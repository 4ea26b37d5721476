#include "fusion/strips/strip_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/bilinear.h"

namespace curvefusion {

namespace {

constexpr double kStep = StripProfile::kStepPx;
// Chosen: arrays of fixed size hold a profile 127 px across.
constexpr int kMaxValues = 256;
// Chosen: a strip is more than a pixel wide, a guard about as wide as the images' blur
// (ImageBlur::luma_px), and a side wide enough to tell its scatter.
constexpr int kMinWidth = 3;  // steps
constexpr int kGuard = 2;     // steps; around an edge the blur mixes both colours
constexpr int kSide = 7;      // steps of background compared on either side
constexpr float kNoise = 3;   // grey levels; keeps flat regions from winning by zero noise
// Chosen: the images' blur (ImageBlur::luma_px) carries a strip's colour no farther, three standard
// deviations; background is averaged over four values beyond.
constexpr double kTailPx = 3;
constexpr double kSidePx = 2;  // of background, beyond the tail
static_assert(kStripMarginPx == kTailPx + kSidePx);

// Sums over a profile, so that the line fitted to any run of it costs a few subtractions.
struct PrefixSums {
  std::array<Eigen::Array3f, kMaxValues + 1> value;
  std::array<Eigen::Array3f, kMaxValues + 1> moment;  // index times value
  std::array<float, kMaxValues + 1> square;

  explicit PrefixSums(const StripProfile& profile) {
    const Eigen::Vector3f offset = profile.values[profile.values.size() / 2];
    value[0].setZero();
    moment[0].setZero();
    square[0] = 0;
    for (size_t i = 0; i < profile.values.size(); ++i) {
      const Eigen::Array3f v = profile.values[i] - offset;
      value[i + 1] = value[i] + v;
      moment[i + 1] = moment[i] + static_cast<float>(i) * v;
      square[i + 1] = square[i] + v.square().sum();
    }
  }

  Eigen::Array3f Mean(int begin, int end) const {
    return (value[end] - value[begin]) / static_cast<float>(end - begin);
  }

  // Sum of squared deviations from the mean.
  float Scatter(int begin, int end) const {
    const Eigen::Array3f sum = value[end] - value[begin];
    return square[end] - square[begin] - sum.square().sum() / static_cast<float>(end - begin);
  }

  // What a straight line explains of the scatter.
  float LinearPart(int begin, int end) const {
    const auto n = static_cast<float>(end - begin);
    if (end - begin < 3) return 0;
    const float middle = 0.5f * static_cast<float>(begin + end - 1);
    const Eigen::Array3f covariance =
        moment[end] - moment[begin] - middle * (value[end] - value[begin]);
    return covariance.square().sum() * 12 / (n * (n * n - 1));
  }
};

struct Separation {
  float squared_contrast = 0;  // to the less different side
  float score = 0;             // against the scatter
};

Separation Separate(const PrefixSums& sums, int begin, int end) {
  const int guard = std::min(kGuard, (end - begin - 1) / 2);
  const int left_end = begin - kGuard;
  const int right_begin = end + kGuard;
  const Eigen::Array3f inside = sums.Mean(begin + guard, end - guard);
  const Eigen::Array3f left = sums.Mean(left_end - kSide, left_end);
  const Eigen::Array3f right = sums.Mean(right_begin, right_begin + kSide);
  Separation result;
  // The product is negative across a mere edge, whose blur would pass for a shaded strip.
  result.squared_contrast =
      std::min({(inside - left).square().sum(), (inside - right).square().sum(),
                ((inside - left) * (inside - right)).sum()});
  const float scatter =
      sums.Scatter(left_end - kSide, left_end) + sums.Scatter(right_begin, right_begin + kSide) +
      sums.Scatter(begin + guard, end - guard) - sums.LinearPart(begin + guard, end - guard);
  const auto count = static_cast<float>(2 * kSide + end - begin - 2 * guard);
  result.score = result.squared_contrast / (scatter / count + kNoise * kNoise);
  return result;
}

// The straight line through the two sides of a strip.
struct Background {
  double middle_px = 0;
  Eigen::Vector3d mean;
  Eigen::Vector3d slope;  // per px

  Eigen::Vector3d At(double offset_px) const { return mean + (offset_px - middle_px) * slope; }
};

int IndexAt(const StripProfile& profile, double offset_px) {
  return static_cast<int>(std::lround((offset_px - profile.first_px) / kStep));
}

Eigen::Vector3d MeanOf(const StripProfile& profile, int begin, int end) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = begin; i < end; ++i) sum += profile.values[i].cast<double>();
  return sum / (end - begin);
}

// Range of the values that a strip may have changed, background beyond it.
struct Window {
  int begin = 0;
  int end = 0;
  bool fits = false;
};

constexpr int kSideCount = static_cast<int>(kSidePx / kStep);

Window WindowOf(const StripProfile& profile, const StripPosition& position) {
  const double half_px = 0.5 * position.width_px + kTailPx;
  Window window;
  window.begin = IndexAt(profile, position.center_px - half_px);
  window.end = IndexAt(profile, position.center_px + half_px) + 1;
  window.fits = window.begin >= kSideCount &&
                window.end + kSideCount <= static_cast<int>(profile.values.size());
  return window;
}

Background FitBackground(const StripProfile& profile, const Window& window) {
  const Eigen::Vector3d left = MeanOf(profile, window.begin - kSideCount, window.begin);
  const Eigen::Vector3d right = MeanOf(profile, window.end, window.end + kSideCount);
  Background background;
  background.middle_px =
      profile.offset_px(window.begin) + 0.5 * kStep * (window.end - 1 - window.begin);
  background.mean = 0.5 * (left + right);
  background.slope = (right - left) / (kStep * (window.end - window.begin + kSideCount));
  return background;
}

}  // namespace

StripProfile ReadProfile(const ColorImage& image, const ProjectedSample& sample,
                         double half_width_px, int half_length_px) {
  StripProfile profile;
  const int half_count = std::min(static_cast<int>(half_width_px / kStep), kMaxValues / 2 - 1);
  profile.first_px = -half_count * kStep;
  profile.values.resize(static_cast<size_t>(2 * half_count + 1));
  for (int i = -half_count; i <= half_count; ++i) {
    Eigen::Vector3f rgb = Eigen::Vector3f::Zero();
    for (int j = -half_length_px; j <= half_length_px; ++j) {
      const Vec2 pixel = sample.pixel + i * kStep * sample.normal + j * sample.tangent;
      rgb += Bilinear(image, pixel.x(), pixel.y());
    }
    profile.values[static_cast<size_t>(i + half_count)] =
        rgb / static_cast<float>(2 * half_length_px + 1);
  }
  return profile;
}

std::optional<StripPosition> FindStrip(const StripProfile& profile, double search_px,
                                       double max_width_px, double min_contrast) {
  const PrefixSums sums(profile);
  const int n = static_cast<int>(profile.values.size());
  const double middle = -profile.first_px / kStep;
  const int max_width = static_cast<int>(max_width_px / kStep);
  StripPosition best;
  float best_score = 0;
  for (int width = kMinWidth; width <= max_width; width += std::max(1, width / 8)) {
    const double first = middle - 0.5 * (width - 1) - search_px / kStep;
    const int begin_first = std::max(static_cast<int>(std::ceil(first)), kGuard + kSide);
    const int begin_last =
        std::min(static_cast<int>(first + 2 * search_px / kStep), n - width - kGuard - kSide);
    for (int begin = begin_first; begin <= begin_last; ++begin) {
      const Separation found = Separate(sums, begin, begin + width);
      if (found.score <= best_score || found.squared_contrast < min_contrast * min_contrast)
        continue;
      best_score = found.score;
      best = {profile.offset_px(begin) + 0.5 * (width - 1) * kStep, width * kStep};
    }
  }
  if (best_score <= 0) return std::nullopt;
  return best;
}

std::optional<StripColors> MeasureStrip(const StripProfile& profile,
                                        const StripPosition& position) {
  const Window window = WindowOf(profile, position);
  if (!window.fits) return std::nullopt;
  const Background background = FitBackground(profile, window);
  StripColors colors;
  colors.background = background.At(position.center_px);
  colors.mass.setZero();
  for (int i = window.begin; i < window.end; ++i) {
    colors.mass += kStep * (background.At(profile.offset_px(i)) - profile.values[i].cast<double>());
  }
  const int center = IndexAt(profile, position.center_px);
  colors.center = MeanOf(profile, center, center + 1);
  colors.interior = MeanOf(profile, IndexAt(profile, position.center_px - 0.5 * position.width_px),
                           IndexAt(profile, position.center_px + 0.5 * position.width_px) + 1);
  return colors;
}

double StripCentroid(const StripProfile& profile, const StripPosition& position,
                     const Eigen::Vector3d& weights) {
  const Window window = WindowOf(profile, position);
  if (!window.fits) return position.center_px;
  const Background background = FitBackground(profile, window);
  double mass = 0;
  double moment = 0;
  for (int i = window.begin; i < window.end; ++i) {
    const double offset = profile.offset_px(i);
    const double difference = weights.dot(background.At(offset) - profile.values[i].cast<double>());
    mass += difference;
    moment += difference * offset;
  }
  if (mass <= 0) return position.center_px;
  return std::clamp(moment / mass, position.center_px - 1, position.center_px + 1);
}

}  // namespace curvefusion
