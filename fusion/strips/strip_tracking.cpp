#include "fusion/strips/strip_tracking.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/wide_lanes.h"

namespace curvefusion {

namespace {

constexpr double kStep = StripContrast::kStepPx;  // between centres, which the centroid refines
constexpr int kGuard = StripContrast::kGuard;
constexpr int kSide = StripContrast::kSide;
constexpr auto kMinScore = static_cast<float>(StripContrast::kMinScore);
constexpr auto kMaxSecond = static_cast<float>(StripContrast::kMaxSecond);
// Chosen: widths a fifth apart.
constexpr double kMinWidthPx = 2;
constexpr std::array<double, 5> kWidths = {0.7, 0.85, 1, 1.2, 1.45};  // of the expected
constexpr int kMaxJump = 3;                                           // steps between neighbours
// By jumps from -kMaxJump to kMaxJump. Chosen: .02 times squared steps.
constexpr std::array<float, 2 * kMaxJump + 1> kJumpCosts = {0.18f, 0.08f, 0.02f, 0,
                                                            0.02f, 0.08f, 0.18f};
// Chosen: what has other curves beside it is no measurement.
constexpr double kClearWidths = 0.85;  // with 1.2 a tenth more of some curves is unmeasured
constexpr double kClearPx = 2;
constexpr int kMaxRunGap = 1;  // samples left out within a run
// So many samples before and behind those clear of other curves take part in the path. Chosen: 24
// mm of a curve whose vertices are 3 mm apart.
constexpr size_t kLead = 8;

// Posterior across a curve and its running sum.
struct Profile {
  int half_count = 0;
  std::vector<float> values;  // 2 half_count + 1
  std::vector<float> sums;    // one more

  // Over [begin, end), in steps from the middle; must lie inside.
  float Sum(int begin, int end) const { return sums[end + half_count] - sums[begin + half_count]; }
};

// Where values between four pixels are read.
struct BilinearPlaces {
  std::vector<int> pixels;  // the upper left of the four, by its index in the image
  std::vector<float> a, b;  // 0 to 1, from there to the right and down
  void Resize(size_t count) {
    pixels.resize(count);
    a.resize(count);
    b.resize(count);
  }
};

// Places along a line, those outside of the image, and what is no number, moved to its border.
CURVEFUSION_WIDE_LANES void FindPlaces(const PosteriorImage& image, const ProjectedSample& sample,
                                       int half_count, BilinearPlaces& places) {
  const double x = sample.pixel.x(), y = sample.pixel.y();
  const double along_x = sample.normal.x(), along_y = sample.normal.y();
  const double last_u = image.width() - 1, last_v = image.height() - 1;
  const int width = image.width(), height = image.height();
  int* pixels = places.pixels.data();
  float* to_right = places.a.data();
  float* down = places.b.data();
  for (int i = 0; i < 2 * half_count + 1; ++i) {
    const double t = (i - half_count) * kStep;
    double u = x + t * along_x;
    double v = y + t * along_y;
    u = u > 0 ? u : 0;
    v = v > 0 ? v : 0;
    u = u < last_u ? u : last_u;
    v = v < last_v ? v : last_v;
    const int u0 = std::min(static_cast<int>(u), width - 2);
    const int v0 = std::min(static_cast<int>(v), height - 2);
    pixels[i] = v0 * width + u0;
    to_right[i] = static_cast<float>(u - u0);
    down[i] = static_cast<float>(v - v0);
  }
}

// Posteriors, 0 to 1.
void ReadPlaces(const PosteriorImage& image, const BilinearPlaces& places,
                std::vector<float>& values) {
  for (size_t i = 0; i < values.size(); ++i) {
    const uint8_t* top = image.data() + places.pixels[i];
    const uint8_t* bottom = top + image.width();
    const float upper =
        static_cast<float>(top[0]) + places.a[i] * static_cast<float>(top[1] - top[0]);
    const float lower =
        static_cast<float>(bottom[0]) + places.a[i] * static_cast<float>(bottom[1] - bottom[0]);
    values[i] = (upper + places.b[i] * (lower - upper)) * (1 / 255.0f);
  }
}

void ReadProfile(const PosteriorImage& image, const ProjectedSample& sample, int half_count,
                 BilinearPlaces& places, Profile& profile) {
  profile.half_count = half_count;
  profile.values.resize(2 * half_count + 1);
  profile.sums.resize(2 * half_count + 2);
  places.Resize(profile.values.size());
  FindPlaces(image, sample, half_count, places);
  ReadPlaces(image, places, profile.values);
  profile.sums[0] = 0;
  for (int i = 0; i < 2 * half_count + 1; ++i)
    profile.sums[i + 1] = profile.sums[i] + profile.values[i];
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

int WidthSteps(double width_px) {
  return std::max(static_cast<int>(std::lround(width_px / kStep)),
                  static_cast<int>(kMinWidthPx / kStep));
}

// Raises the scores of centres for which strips of this width stand out more than those before.
// `sums` points at the running sum where the first centre's strip begins.
CURVEFUSION_WIDE_LANES void RaiseScores(const float* __restrict sums, int width, int centres,
                                        float* __restrict scores, float* __restrict widths_px) {
  const float per_width = 1 / static_cast<float>(width);
  const auto width_px = static_cast<float>(width * kStep);
  for (int c = 0; c < centres; ++c) {
    const float* begin = sums + c;
    const float* end = begin + width;
    const float inside = (end[0] - begin[0]) * per_width;
    const float left = begin[-kGuard] - begin[-kGuard - kSide];
    const float right = end[kGuard + kSide] - end[kGuard];
    const float score = inside - (left < right ? right : left) * (1.0f / kSide);
    const bool is_better = score > scores[c];
    widths_px[c] = is_better ? width_px : widths_px[c];
    scores[c] = is_better ? score : scores[c];
  }
}

void ScoreCentres(const Profile& profile, double width_px, size_t row, Scores& scores) {
  std::fill_n(scores.Row(row), scores.columns(), -1.0f);
  int last_width = 0;
  for (const double factor : kWidths) {
    const int width = WidthSteps(factor * width_px) | 1;  // odd: centres lie on steps
    if (width == last_width) continue;
    last_width = width;
    const int first = profile.half_count - scores.half_count - width / 2;
    RaiseScores(profile.sums.data() + first, width, scores.columns(), scores.Row(row),
                scores.WidthRow(row));
  }
}

// Of all paths from the centres of one row to those of the next the best each. `before` has room
// for kMaxJump centres beyond both ends.
CURVEFUSION_WIDE_LANES void JumpToNext(const float* __restrict before, int centres,
                                       float* __restrict best, int* __restrict jumps) {
  for (int jump = -kMaxJump; jump <= kMaxJump; ++jump) {
    const float cost = kJumpCosts[jump + kMaxJump];
    for (int c = 0; c < centres; ++c) {
      const float value = before[c - jump] - cost;
      const bool is_better = value > best[c];
      best[c] = is_better ? value : best[c];
      jumps[c] = is_better ? jump : jumps[c];
    }
  }
}

// The sequence of centres, one a row of [begin, end), of the greatest sum of scores minus jumps.
void BestPath(const Scores& scores, size_t begin, size_t end, std::vector<int>& path) {
  const int n = scores.columns();
  // Beyond both ends, from where no path comes. Chosen: less than any sum of scores, -1 each.
  constexpr float kNowhere = -1e9f;
  std::vector<float> padded(static_cast<size_t>(n) + 2 * kMaxJump, kNowhere);
  float* total = padded.data() + kMaxJump;
  std::copy_n(scores.Row(begin), n, total);
  std::vector<float> next(n);
  std::vector<int> came_by((end - begin) * static_cast<size_t>(n), 0);
  for (size_t row = begin + 1; row < end; ++row) {
    std::ranges::fill(next, kNowhere);
    JumpToNext(total, n, next.data(), came_by.data() + (row - begin) * static_cast<size_t>(n));
    for (int c = 0; c < n; ++c) total[c] = next[c] + scores.Row(row)[c];
  }
  int c = static_cast<int>(std::max_element(total, total + n) - total);
  for (size_t row = end; row-- > begin;) {
    path[row] = c;
    c -= came_by[(row - begin) * static_cast<size_t>(n) + c];
  }
}

// Another curve is as far off as this one, and looks the same: what lies nearer to it is its own.
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

bool FollowsOn(const ProjectedSample& before, const ProjectedSample& sample) {
  return sample.edge == before.edge && sample.index - before.index <= 1 + kMaxRunGap;
}

// Whether each sample is clear of other curves or so near to one that is that it leads the way
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

bool IsClear(double clearance_px, double width_px) {
  return clearance_px > kClearWidths * width_px + kClearPx;
}

std::vector<TrackedStrip> TrackStrips(const PosteriorImage& posterior,
                                      const std::vector<ProjectedSample>& samples,
                                      const std::vector<double>& radii, double search_px) {
  const auto expected_px = [&](size_t i) { return samples[i].WidthPx(radii[i]); };
  std::vector<char> is_clear(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    is_clear[i] = IsClear(samples[i].clearance_px, expected_px(i));
  }
  const std::vector<char> leads = MarkLeading(is_clear);
  Scores scores;
  scores.half_count = static_cast<int>(search_px / kStep);
  scores.values.resize(samples.size() * static_cast<size_t>(scores.columns()));
  scores.widths_px.resize(scores.values.size());
  std::vector<Profile> profiles(samples.size());
  BilinearPlaces places;
  for (size_t i = 0; i < samples.size(); ++i) {
    if (!leads[i]) continue;
    const int reach = WidthSteps(kWidths.back() * expected_px(i)) / 2 + 2 + kGuard + kSide;
    ReadProfile(posterior, samples[i], scores.half_count + reach, places, profiles[i]);
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
