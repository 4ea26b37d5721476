#include "fusion/strips/strip_tracking.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace curvefusion {

namespace {

constexpr double kStep = 0.5;   // pixels, between centres
constexpr double kGuardPx = 1;  // blurred edge between strip and side
constexpr double kSidePx = 4;   // of background compared on either side
constexpr double kMinWidthPx = 2;
constexpr std::array<double, 5> kWidths = {0.7, 0.85, 1, 1.2, 1.45};  // of the expected
constexpr int kMaxJump = 3;                                           // steps between neighbours
// By jumps from -kMaxJump to kMaxJump: .02 times squared steps.
constexpr std::array<float, 2 * kMaxJump + 1> kJumpCosts = {0.18f, 0.08f, 0.02f, 0,
                                                            0.02f, 0.08f, 0.18f};
constexpr float kMinScore = 0.35f;
constexpr float kMaxSecond = 0.7f;     // of the best score
constexpr double kClearWidths = 0.85;  // 1.2 leaves a tenth more of some curves unmeasured
constexpr double kClearPx = 2;
constexpr int kMaxRunGap = 1;  // samples left out within a run
// So many samples before and behind those clear of other strands take part in the path.
constexpr size_t kLead = 8;

// Posterior, 0 to 1, at a place of the image.
float Bilinear(const PosteriorImage& image, double u, double v) {
  const int u0 = std::clamp(static_cast<int>(u), 0, image.width() - 2);
  const int v0 = std::clamp(static_cast<int>(v), 0, image.height() - 2);
  const auto a = static_cast<float>(std::clamp(u - u0, 0.0, 1.0));
  const auto b = static_cast<float>(std::clamp(v - v0, 0.0, 1.0));
  const uint8_t* top = image.row(v0) + u0;
  const uint8_t* bottom = image.row(v0 + 1) + u0;
  const float upper = static_cast<float>(top[0]) + a * static_cast<float>(top[1] - top[0]);
  const float lower = static_cast<float>(bottom[0]) + a * static_cast<float>(bottom[1] - bottom[0]);
  return (upper + b * (lower - upper)) * (1 / 255.0f);
}

// Posterior across a curve and its running sum.
struct Profile {
  int half_count = 0;
  std::vector<float> values;  // 2 half_count + 1
  std::vector<float> sums;    // one more

  // Over [begin, end), in steps from the middle; must lie inside.
  float Sum(int begin, int end) const { return sums[end + half_count] - sums[begin + half_count]; }
};

void ReadProfile(const PosteriorImage& image, const ProjectedSample& sample, int half_count,
                 Profile& profile) {
  profile.half_count = half_count;
  profile.values.resize(2 * half_count + 1);
  profile.sums.resize(2 * half_count + 2);
  profile.sums[0] = 0;
  for (int i = 0; i < 2 * half_count + 1; ++i) {
    const Vec2 pixel = sample.pixel + (i - half_count) * kStep * sample.normal;
    profile.values[i] = Bilinear(image, pixel.x(), pixel.y());
    profile.sums[i + 1] = profile.sums[i] + profile.values[i];
  }
}

// Scores of all centres, with the best width each.
struct Scores {
  int half_count = 0;         // centres are -half_count ... half_count
  std::vector<float> values;  // row by row, one row a sample
  std::vector<float> widths_px;

  int columns() const { return 2 * half_count + 1; }
  float* Row(size_t i) { return values.data() + i * static_cast<size_t>(columns()); }
  const float* Row(size_t i) const { return values.data() + i * static_cast<size_t>(columns()); }
  float* WidthRow(size_t i) { return widths_px.data() + i * static_cast<size_t>(columns()); }
  const float* WidthRow(size_t i) const {
    return widths_px.data() + i * static_cast<size_t>(columns());
  }
};

constexpr int kGuard = static_cast<int>(kGuardPx / kStep);
constexpr int kSide = static_cast<int>(kSidePx / kStep);

int WidthSteps(double width_px) {
  return std::max(static_cast<int>(std::lround(width_px / kStep)),
                  static_cast<int>(kMinWidthPx / kStep));
}

void ScoreCentres(const Profile& profile, double width_px, size_t row, Scores& scores) {
  float* values = scores.Row(row);
  float* widths = scores.WidthRow(row);
  std::fill(values, values + scores.columns(), -1.0f);
  int last_width = 0;
  for (const double factor : kWidths) {
    const int width = WidthSteps(factor * width_px) | 1;  // odd: centres lie on steps
    if (width == last_width) continue;
    last_width = width;
    const float per_width = 1 / static_cast<float>(width);
    for (int c = -scores.half_count; c <= scores.half_count; ++c) {
      const int begin = c - width / 2;
      const int end = begin + width;
      const float inside = profile.Sum(begin, end) * per_width;
      const float left = profile.Sum(begin - kGuard - kSide, begin - kGuard);
      const float right = profile.Sum(end + kGuard, end + kGuard + kSide);
      const float score = inside - std::max(left, right) * (1.0f / kSide);
      float& best = values[c + scores.half_count];
      if (score <= best) continue;
      best = score;
      widths[c + scores.half_count] = static_cast<float>(width * kStep);
    }
  }
}

// The sequence of centres, one a row of [begin, end), of the greatest sum of scores minus jumps.
void BestPath(const Scores& scores, size_t begin, size_t end, std::vector<int>& path) {
  const int n = scores.columns();
  // Beyond both ends, from where no path comes.
  constexpr float kNowhere = -1e9f;
  std::vector<float> padded(static_cast<size_t>(n) + 2 * kMaxJump, kNowhere);
  float* total = padded.data() + kMaxJump;
  std::copy_n(scores.Row(begin), n, total);
  std::vector<float> next(n);
  std::vector<int8_t> came_by((end - begin) * static_cast<size_t>(n), 0);
  for (size_t row = begin + 1; row < end; ++row) {
    int8_t* jumps = came_by.data() + (row - begin) * static_cast<size_t>(n);
    for (int c = 0; c < n; ++c) {
      float best = kNowhere;
      for (int jump = -kMaxJump; jump <= kMaxJump; ++jump) {
        const float value = total[c - jump] - kJumpCosts[jump + kMaxJump];
        if (value <= best) continue;
        best = value;
        jumps[c] = static_cast<int8_t>(jump);
      }
      next[c] = best + scores.Row(row)[c];
    }
    std::ranges::copy(next, total);
  }
  int c = static_cast<int>(std::max_element(total, total + n) - total);
  for (size_t row = end; row-- > begin;) {
    path[row] = c;
    c -= came_by[(row - begin) * static_cast<size_t>(n) + c];
  }
}

// Another strand is as far off as this one, and looks the same: what lies nearer to it is its own.
void LeaveToNeighbour(double clearance_px, size_t row, Scores& scores) {
  float* values = scores.Row(row);
  for (int c = -scores.half_count; c <= scores.half_count; ++c) {
    if (std::abs(c) * kStep > clearance_px / 2) values[c + scores.half_count] = -1;
  }
}

// Whether a centre farther away than the strip reaches is nearly as good.
bool HasRival(const Scores& scores, size_t row, int chosen) {
  const float* values = scores.Row(row);
  const int reach = static_cast<int>(scores.WidthRow(row)[chosen] / kStep) + kGuard;
  for (int c = 0; c < scores.columns(); ++c) {
    if (std::abs(c - chosen) > reach && values[c] > kMaxSecond * values[chosen]) return true;
  }
  return false;
}

// Centre of the posterior's mass above the line between both sides: finer than the steps.
double Centroid(const Profile& profile, double centre_px, double width_px) {
  const int width = WidthSteps(width_px) | 1;
  const int reach = width / 2 + kGuard;
  const int middle = static_cast<int>(std::lround(centre_px / kStep));
  const float left = profile.Sum(middle - reach - kSide, middle - reach) / kSide;
  const float right = profile.Sum(middle + reach + 1, middle + reach + 1 + kSide) / kSide;
  double mass = 0;
  double moment = 0;
  for (int i = middle - reach; i <= middle + reach; ++i) {
    const float share = static_cast<float>(i - middle + reach) / static_cast<float>(2 * reach);
    const double value = profile.values[i + profile.half_count] - (left + share * (right - left));
    mass += value;
    moment += value * (i - middle);
  }
  if (mass <= 0) return centre_px;
  return kStep * (middle + std::clamp(moment / mass, -2.0, 2.0));
}

bool IsClear(const ProjectedSample& sample, double width_px) {
  return sample.clearance_px > kClearWidths * width_px + kClearPx;
}

bool FollowsOn(const ProjectedSample& before, const ProjectedSample& sample) {
  return sample.edge == before.edge && sample.index - before.index <= 1 + kMaxRunGap;
}

// Whether each sample is clear of other strands or so near to one that is that it leads the way
// there.
std::vector<char> MarkLeading(const std::vector<char>& is_clear) {
  std::vector<char> leads(is_clear.size(), 0);
  for (size_t i = 0; i < is_clear.size(); ++i) {
    if (!is_clear[i]) continue;
    const size_t first = i - std::min(i, kLead);
    const size_t last = std::min(i + kLead, is_clear.size() - 1);
    std::fill(leads.begin() + static_cast<std::ptrdiff_t>(first),
              leads.begin() + static_cast<std::ptrdiff_t>(last) + 1, 1);
  }
  return leads;
}

}  // namespace

std::vector<TrackedStrip> TrackStrips(const PosteriorImage& posterior,
                                      const std::vector<ProjectedSample>& samples,
                                      const std::vector<double>& radii, double search_px) {
  const auto expected_px = [&](size_t i) { return 2 * radii[i] / samples[i].metres_per_px; };
  std::vector<char> is_clear(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) is_clear[i] = IsClear(samples[i], expected_px(i));
  const std::vector<char> leads = MarkLeading(is_clear);
  Scores scores;
  scores.half_count = static_cast<int>(search_px / kStep);
  scores.values.resize(samples.size() * static_cast<size_t>(scores.columns()));
  scores.widths_px.resize(scores.values.size());
  std::vector<Profile> profiles(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!leads[i]) continue;
    const int reach = WidthSteps(kWidths.back() * expected_px(i)) / 2 + 2 + kGuard + kSide;
    ReadProfile(posterior, samples[i], scores.half_count + reach, profiles[i]);
    ScoreCentres(profiles[i], expected_px(i), i, scores);
    if (is_clear[i]) LeaveToNeighbour(samples[i].clearance_px, i, scores);
  }
  std::vector<int> path(samples.size());
  for (size_t begin = 0, end = 0; begin < samples.size(); begin = end) {
    end = begin + 1;
    if (!leads[begin]) continue;
    while (end < samples.size() && leads[end] && FollowsOn(samples[end - 1], samples[end])) ++end;
    BestPath(scores, begin, end, path);
  }
  std::vector<TrackedStrip> tracked(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    TrackedStrip& strip = tracked[i];
    strip.sample = static_cast<int>(i);
    if (!is_clear[i]) continue;
    strip.score = scores.Row(i)[path[i]];
    strip.width_px = scores.WidthRow(i)[path[i]];
    const double centre_px = (path[i] - scores.half_count) * kStep;
    strip.offset_px = Centroid(profiles[i], centre_px, strip.width_px);
    strip.accepted = strip.score >= kMinScore && !HasRival(scores, i, path[i]);
  }
  return tracked;
}

}  // namespace curvefusion
