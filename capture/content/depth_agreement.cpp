#include "capture/content/depth_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernel/parallel.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr std::array<int, 4> kGaps = {1, 3, 10, 30};
// Every third pixel in both directions is moved: 1,400 points of a full thumbnail, of which the
// median is known to 3 % of the spread.
constexpr int kSampleStep = 3;
// Chosen: a difference beyond 5 % of the distance is another surface, or plainly wrong; 35 mm at
// .7 m, ten times what depth and poses of a good scan disagree by.
constexpr double kCostLimit = 0.05;
// Chosen: neighbours of one surface seen under 80 degrees differ by less at this resolution.
constexpr float kMaxSurfaceStep = 0.05F;
constexpr double kMinOverlap = 0.15;  // chosen: less than that is a corner of the image
constexpr int kMinOverlapPoints = 60;

uint16_t Swapped(uint16_t value) { return static_cast<uint16_t>((value << 8) | (value >> 8)); }

DepthImage Metric(const Image<uint16_t>& raw, double depth_scale, bool swap_bytes) {
  DepthImage depth(raw.width(), raw.height());
  for (size_t i = 0; i < raw.size(); ++i) {
    const uint16_t value = swap_bytes ? Swapped(raw.data()[i]) : raw.data()[i];
    depth.data()[i] = static_cast<float>(value / depth_scale);
  }
  return depth;
}

// Depth between four pixels of one surface (0: not one surface). Inverse depth is linear over a
// plane's image.
float Between(const DepthImage& depth, double u, double v) {
  const int left = static_cast<int>(std::floor(u));
  const int top = static_cast<int>(std::floor(v));
  if (left < 0 || top < 0 || left + 1 >= depth.width() || top + 1 >= depth.height()) return 0;
  const float* upper = depth.row(top) + left;
  const float* lower = depth.row(top + 1) + left;
  const auto [least, greatest] = std::minmax({upper[0], upper[1], lower[0], lower[1]});
  if (!(least > 0) || greatest - least > kMaxSurfaceStep * least) return 0;
  const float x = static_cast<float>(u - left);
  const float y = static_cast<float>(v - top);
  return 1 /
         ((1 - y) * ((1 - x) / upper[0] + x / upper[1]) + y * ((1 - x) / lower[0] + x / lower[1]));
}

PairAgreement Summarize(const std::vector<DepthViews::Overlap>& overlaps, int samples) {
  PairAgreement agreement;
  if (samples == 0) return agreement;
  agreement.overlap = static_cast<double>(overlaps.size()) / samples;
  agreement.is_usable =
      agreement.overlap >= kMinOverlap && overlaps.size() >= static_cast<size_t>(kMinOverlapPoints);
  if (overlaps.empty()) return agreement;
  std::vector<double> relative;
  std::vector<double> absolute;
  double cost = 0;
  for (const DepthViews::Overlap& overlap : overlaps) {
    absolute.push_back(std::abs(overlap.difference));
    relative.push_back(std::abs(overlap.difference) / overlap.distance);
    cost += std::min(relative.back() / kCostLimit, 1.0);
  }
  agreement.cost = cost / static_cast<double>(overlaps.size());
  agreement.residual = Median(std::move(relative));
  agreement.difference = Median(std::move(absolute));
  return agreement;
}

double MedianOrZero(std::vector<double> values) {
  return values.empty() ? 0 : Median(std::move(values));
}

}  // namespace

std::vector<FramePair> SpreadPairs(int frame_count, int starts) {
  std::vector<FramePair> pairs;
  for (const int gap : kGaps) {
    if (gap > 1 && 2 * gap > frame_count) break;
    const int places = frame_count - gap;
    const int count = std::min(starts, places);
    for (int i = 0; i < count; ++i) {
      const int from = static_cast<int>((2 * int64_t{i} + 1) * places / (2 * count));
      pairs.push_back({from, from + gap});
    }
  }
  return pairs;
}

std::vector<int> FramesOf(const std::vector<FramePair>& pairs) {
  std::vector<int> frames;
  for (const FramePair& pair : pairs) {
    frames.push_back(pair.from);
    frames.push_back(pair.to);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

DepthViews::DepthViews(const Thumbnails& thumbnails, double depth_scale, bool swap_bytes)
    : camera_(thumbnails.depth_camera), depth_(thumbnails.depth.size()) {
  for (size_t i = 0; i < depth_.size(); ++i) {
    depth_[i] = Metric(thumbnails.depth[i], depth_scale, swap_bytes);
  }
}

std::vector<DepthViews::Overlap> DepthViews::Overlaps(int from, int to,
                                                      const RigidTransform& T_to_from,
                                                      int& samples) const {
  const DepthImage& source = depth(from);
  const DepthImage& target = depth(to);
  std::vector<Overlap> overlaps;
  samples = 0;
  for (int v = kSampleStep / 2; v < source.height(); v += kSampleStep) {
    for (int u = kSampleStep / 2; u < source.width(); u += kSampleStep) {
      const double z = source(u, v);
      if (!(z > 0)) continue;
      ++samples;
      const Vec3 p_to = T_to_from * camera_.Unproject(u, v, z);
      if (!(p_to.z() > 0)) continue;
      const Vec2 pixel = camera_.Project(p_to);
      if (!camera_.Contains(pixel)) continue;
      const float seen = Between(target, pixel.x(), pixel.y());
      if (seen > 0) overlaps.push_back({seen, static_cast<float>(seen - p_to.z())});
    }
  }
  return overlaps;
}

PairAgreement DepthViews::Compare(const FramePair& pair, const RigidTransform& T_to_from) const {
  int forth_samples = 0;
  int back_samples = 0;
  std::vector<Overlap> overlaps = Overlaps(pair.from, pair.to, T_to_from, forth_samples);
  const std::vector<Overlap> back = Overlaps(pair.to, pair.from, T_to_from.inverse(), back_samples);
  overlaps.insert(overlaps.end(), back.begin(), back.end());
  return Summarize(overlaps, forth_samples + back_samples);
}

PoseAgreement MeasureAgreement(const DepthViews& views, const std::vector<FramePair>& pairs,
                               const FramePoses& poses) {
  PoseAgreement agreement;
  agreement.pairs.resize(pairs.size());
  ParallelFor(0, static_cast<int64_t>(pairs.size()), 1, [&](int64_t i) {
    const FramePair& pair = pairs[static_cast<size_t>(i)];
    const auto& from = poses[static_cast<size_t>(pair.from)];
    const auto& to = poses[static_cast<size_t>(pair.to)];
    if (!from || !to || !views.Has(pair.from) || !views.Has(pair.to)) return;
    agreement.pairs[static_cast<size_t>(i)] = views.Compare(pair, to->inverse() * *from);
  });
  std::vector<double> costs;
  std::vector<double> residuals;
  std::vector<double> differences;
  std::vector<double> overlaps;
  for (const PairAgreement& pair : agreement.pairs) {
    overlaps.push_back(pair.overlap);
    if (!pair.is_usable) continue;
    costs.push_back(pair.cost);
    residuals.push_back(pair.residual);
    differences.push_back(pair.difference);
  }
  agreement.usable = static_cast<int>(costs.size());
  agreement.cost = costs.empty() ? 1 : Median(std::move(costs));
  agreement.residual = MedianOrZero(std::move(residuals));
  agreement.difference = MedianOrZero(std::move(differences));
  agreement.overlap = MedianOrZero(std::move(overlaps));
  return agreement;
}

}  // namespace curvefusion
