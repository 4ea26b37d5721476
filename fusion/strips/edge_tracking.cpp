#include "fusion/strips/edge_tracking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fusion/strips/strip_tracking.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kStep = StripContrast::kStepPx;
constexpr int kGuard = StripContrast::kGuard;
constexpr int kSide = StripContrast::kSide;
// Chosen on ten training scans (docs/lab_notebook.md#strips-found-by-their-edges).
constexpr int kBlur = 4;  // steps to either side, as far as an edge is blurred
constexpr double kMinWidthPx = 3;
constexpr double kMaxHalfWidthErrorPx = 1;
constexpr double kLearnSearchPx = 3;
constexpr size_t kMinLearned = 30;   // in an image, for a median
constexpr size_t kMaxLearned = 100;  // about; more take time

// 0 to 1; beyond the image its border goes on.
double Interpolated(const PosteriorImage& image, const Vec2& pixel) {
  const double u = std::clamp(pixel.x(), 0.0, image.width() - 1.0);
  const double v = std::clamp(pixel.y(), 0.0, image.height() - 1.0);
  const int u0 = std::min(static_cast<int>(u), image.width() - 2);
  const int v0 = std::min(static_cast<int>(v), image.height() - 2);
  const double a = u - u0, b = v - v0;
  const double upper = (1 - a) * image(u0, v0) + a * image(u0 + 1, v0);
  const double lower = (1 - a) * image(u0, v0 + 1) + a * image(u0 + 1, v0 + 1);
  return ((1 - b) * upper + b * lower) / 255;
}

// Posteriors along a line, and their means.
class Ray {
 public:
  Ray(const PosteriorImage& image, const Vec2& first, const Vec2& step, int count)
      : sums_(static_cast<size_t>(count) + 1) {
    for (int i = 0; i < count; ++i) sums_[i + 1] = sums_[i] + Interpolated(image, first + i * step);
  }
  double Mean(int begin, int end) const { return (sums_[end] - sums_[begin]) / (end - begin); }

 private:
  std::vector<double> sums_;
};

// How far from `centre` a strip ends in the direction `outward`, looked for within search_px of
// half its width.
std::optional<double> FindEdge(const PosteriorImage& image, const Vec2& centre, const Vec2& outward,
                               double width_px, double search_px) {
  const int width = std::max(static_cast<int>(std::lround(width_px / kStep)), kBlur);
  const int search = static_cast<int>(search_px / kStep);
  const int edges = 2 * search + 1;
  // Of the first value, from the centre; the first edge is `width` farther.
  const int first = static_cast<int>(std::lround(0.5 * width_px / kStep)) - search - width;
  const Ray ray(image, centre + first * kStep * outward, kStep * outward,
                width + edges + kGuard + kSide);
  const auto inside = [&](int k) { return ray.Mean(k, k + width - 1); };
  const auto outside = [&](int k) {
    return ray.Mean(k + width + kGuard, k + width + kGuard + kSide);
  };
  std::vector<double> scores(edges);
  for (int k = 0; k < edges; ++k) scores[k] = inside(k) - outside(k);
  const auto best = std::max_element(scores.begin(), scores.end());
  const int k = static_cast<int>(best - scores.begin());
  if (*best < StripContrast::kMinScore || k == 0 || k == edges - 1) return {};
  for (int other = 1; other + 1 < edges; ++other) {
    const bool is_peak = scores[other] >= scores[other - 1] && scores[other] >= scores[other + 1];
    if (is_peak && std::abs(other - k) > kBlur && scores[other] > StripContrast::kMaxSecond * *best)
      return {};
  }
  // Where a sharp edge would leave as much of the strip around it.
  const int blur = 2 * kBlur + 1;
  const int blurred = k + width - kBlur;
  const double share = (ray.Mean(blurred, blurred + blur) - outside(k)) / *best;
  return (first + blurred - 0.5 + blur * share) * kStep;
}

}  // namespace

std::optional<double> MeasureEdgeExcess(const PosteriorImage& posterior,
                                        std::vector<WholeStrip> whole) {
  std::erase_if(whole, [](const WholeStrip& strip) { return strip.width_px < kMinWidthPx; });
  std::vector<double> excess;
  const size_t stride = std::max<size_t>(1, whole.size() / kMaxLearned);
  for (size_t k = 0; k < whole.size(); k += stride) {
    const auto& [centre, normal, width] = whole[k];
    const auto left = FindEdge(posterior, centre, -normal, width, kLearnSearchPx);
    const auto right = FindEdge(posterior, centre, normal, width, kLearnSearchPx);
    if (left && right) excess.push_back(0.5 * (*left + *right - width));
  }
  if (excess.size() < kMinLearned) return {};
  return Median(std::move(excess));
}

std::optional<double> FindCentreByEdges(const PosteriorImage& posterior,
                                        const ProjectedSample& sample, double radius,
                                        double excess_px, double search_px) {
  const double width = sample.WidthPx(radius);
  if (width < kMinWidthPx) return {};
  std::array<bool, 2> is_clear{};
  std::array<std::optional<double>, 2> edges;
  for (const int side : {0, 1}) {
    is_clear[side] = IsClear(sample.side_clearance_px[side], width);
    const Vec2 outward = side == 0 ? Vec2(-sample.normal) : sample.normal;
    if (is_clear[side]) edges[side] = FindEdge(posterior, sample.pixel, outward, width, search_px);
    if (is_clear[side] && !edges[side]) return {};
  }
  const double half_width = 0.5 * width + excess_px;
  if (edges[0] && edges[1]) {
    const double half_distance = 0.5 * (*edges[0] + *edges[1]);
    if (std::abs(half_distance - half_width) > kMaxHalfWidthErrorPx) return {};
    return 0.5 * (*edges[1] - *edges[0]);
  }
  if (edges[0]) return half_width - *edges[0];
  if (edges[1]) return *edges[1] - half_width;
  return {};
}

}  // namespace curvefusion
