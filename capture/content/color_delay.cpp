#include "capture/content/color_delay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "capture/frame_stream.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kMaxDelay = 10;  // frames
constexpr int kDelays = 2 * kMaxDelay + 1;
constexpr int kGap = 3;         // frames: a hand's motion has changed after a tenth of a second
constexpr int kMaxPairs = 120;  // chosen: .1 s of two cores
constexpr int kStep = 3;        // pixels between samples
constexpr int kMinPairs = 10;
constexpr int kMinPoints = 100;

// Grey between four pixels; negative outside.
double GreyAt(const Image<uint8_t>& grey, const Vec2& pixel) {
  const int u = static_cast<int>(std::floor(pixel.x()));
  const int v = static_cast<int>(std::floor(pixel.y()));
  if (u < 0 || v < 0 || u + 1 >= grey.width() || v + 1 >= grey.height()) return -1;
  const double x = pixel.x() - u;
  const double y = pixel.y() - v;
  return (1 - y) * ((1 - x) * grey(u, v) + x * grey(u + 1, v)) +
         y * ((1 - x) * grey(u, v + 1) + x * grey(u + 1, v + 1));
}

// Where one point stands in the colour images of two frames.
struct SeenTwice {
  Vec2 first;
  Vec2 second;
};

std::vector<SeenTwice> PointsSeenTwice(const DepthViews& views, const Thumbnails& thumbnails,
                                       const RigidTransform& T_color_depth,
                                       const RigidTransform& T_to_from, int from) {
  const DepthImage& depth = views.depth(from);
  std::vector<SeenTwice> points;
  for (int v = kStep / 2; v < depth.height(); v += kStep) {
    for (int u = kStep / 2; u < depth.width(); u += kStep) {
      if (!(depth(u, v) > 0)) continue;
      const Vec3 p_from = views.camera().Unproject(u, v, depth(u, v));
      const Vec3 p_first = T_color_depth * p_from;
      const Vec3 p_second = T_color_depth * (T_to_from * p_from);
      if (!(p_first.z() > 0 && p_second.z() > 0)) continue;
      points.push_back(
          {thumbnails.color_camera.Project(p_first), thumbnails.color_camera.Project(p_second)});
    }
  }
  return points;
}

// Mean difference of grey; `still` leaves the motion out. Negative where too few points are seen.
double GreyDifference(const Image<uint8_t>& first, const Image<uint8_t>& second,
                      const std::vector<SeenTwice>& points, bool still) {
  double sum = 0;
  int count = 0;
  for (const SeenTwice& point : points) {
    const double before = GreyAt(first, point.first);
    const double after = GreyAt(second, still ? point.first : point.second);
    if (before < 0 || after < 0) continue;
    sum += std::abs(after - before);
    ++count;
  }
  return count < kMinPoints ? -1 : sum / count;
}

// Costs of a pair of frames by delay; negative where an image is missing.
using DelayCosts = std::array<double, kDelays>;

const Image<uint8_t>* GreyOf(const Thumbnails& thumbnails, int frame) {
  if (frame < 0 || frame >= static_cast<int>(thumbnails.grey.size())) return nullptr;
  const Image<uint8_t>& grey = thumbnails.grey[static_cast<size_t>(frame)];
  return grey.empty() ? nullptr : &grey;
}

DelayCosts CostsOf(const DepthViews& views, const Thumbnails& thumbnails,
                   const RigidTransform& T_color_depth, const FramePoses& poses, int from) {
  DelayCosts costs;
  costs.fill(-1);
  const int to = from + kGap;
  const auto points = PointsSeenTwice(
      views, thumbnails, T_color_depth,
      poses[static_cast<size_t>(to)]->inverse() * *poses[static_cast<size_t>(from)], from);
  for (int k = 0; k < kDelays; ++k) {
    const Image<uint8_t>* first = GreyOf(thumbnails, from + k - kMaxDelay);
    const Image<uint8_t>* second = GreyOf(thumbnails, to + k - kMaxDelay);
    if (first == nullptr || second == nullptr) continue;
    const double moved = GreyDifference(*first, *second, points, false);
    const double still = GreyDifference(*first, *second, points, true);
    if (moved >= 0 && still > 0) costs[static_cast<size_t>(k)] = moved / still;
  }
  return costs;
}

// A delay against none, over the pairs that have images for both.
std::optional<ColorDelay> Compared(const std::vector<DelayCosts>& pairs, size_t delay) {
  ColorDelay compared;
  int count = 0;
  int agree = 0;
  for (const DelayCosts& costs : pairs) {
    if (costs[kMaxDelay] < 0 || costs[delay] < 0) continue;
    ++count;
    compared.given += costs[kMaxDelay];
    compared.then += costs[delay];
    agree += costs[delay] < costs[kMaxDelay] ? 1 : 0;
  }
  if (count < kMinPairs) return std::nullopt;
  compared.frames = static_cast<int>(delay) - kMaxDelay;
  compared.given /= count;
  compared.then /= count;
  compared.share = static_cast<double>(agree) / count;
  return compared;
}

std::vector<int> Starts(const DepthViews& views, const FramePoses& poses) {
  std::vector<int> starts;
  const int end = static_cast<int>(poses.size()) - kGap;
  for (int i = 0; i < end; ++i) {
    if (views.Has(i) && poses[static_cast<size_t>(i)] && poses[static_cast<size_t>(i + kGap)]) {
      starts.push_back(i);
    }
  }
  return EvenlyThinned(starts, kMaxPairs);
}

}  // namespace

std::optional<ColorDelay> FindColorDelay(const DepthViews& views, const Thumbnails& thumbnails,
                                         const RigidTransform& T_color_depth,
                                         const FramePoses& poses) {
  const std::vector<int> starts = Starts(views, poses);
  std::vector<DelayCosts> pairs(starts.size());
  ParallelFor(0, static_cast<int64_t>(starts.size()), 1, [&](int64_t i) {
    pairs[static_cast<size_t>(i)] =
        CostsOf(views, thumbnails, T_color_depth, poses, starts[static_cast<size_t>(i)]);
  });
  std::optional<ColorDelay> best;
  for (size_t k = 0; k < kDelays; ++k) {
    const std::optional<ColorDelay> delay = Compared(pairs, k);
    if (!delay) continue;
    if (!best || delay->then * best->given < best->then * delay->given) best = delay;
  }
  return best;
}

}  // namespace curvefusion
