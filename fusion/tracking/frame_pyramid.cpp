#include "fusion/tracking/frame_pyramid.h"

#include <algorithm>
#include <cmath>

#include "capture/content/shrunk_grey.h"
#include "capture/depth_noise.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kBandRows = 16;  // of an image, for a thread at a time; chosen, changes no result
constexpr float kSameSurface = 3.0;  // standard deviations of depth noise; chosen: nearly all
constexpr int kMaxSquare = 16;  // pixels along a side; chosen: images 5120 px wide are taken whole

// The mean of the depths near the median of a square's; 0 where most of it measured nothing.
float SquareDepth(const DepthImage& depth, int first_u, int first_v, int side, float max_depth) {
  float values[kMaxSquare * kMaxSquare];
  int count = 0;
  for (int v = first_v; v < first_v + side; ++v) {
    const float* row = depth.row(v);
    for (int u = first_u; u < first_u + side; ++u) {
      if (row[u] > 0 && row[u] < max_depth) values[count++] = row[u];
    }
  }
  if (2 * count < side * side) return 0;
  std::nth_element(values, values + count / 2, values + count);
  const float median = values[count / 2];
  const float reach = kSameSurface * static_cast<float>(DepthNoise(median));
  float sum = 0;
  int near = 0;
  for (int i = 0; i < count; ++i) {
    if (std::abs(values[i] - median) > reach) continue;
    sum += values[i];
    ++near;
  }
  return 2 * near < side * side ? 0 : sum / static_cast<float>(near);
}

Image<float> HalvedGrey(const Image<float>& grey) {
  Image<float> half(grey.width() / 2, grey.height() / 2, 0);
  for (int v = 0; v < half.height(); ++v) {
    const float* upper = grey.row(2 * v);
    const float* lower = grey.row(2 * v + 1);
    float* row = half.row(v);
    for (int u = 0; u < half.width(); ++u) {
      row[u] = 0.25f * (upper[2 * u] + upper[2 * u + 1] + lower[2 * u] + lower[2 * u + 1]);
    }
  }
  return half;
}

Image<GreySample> WithGradient(const Image<float>& grey) {
  Image<GreySample> samples(grey.width(), grey.height());
  ParallelFor(0, grey.height(), kBandRows, [&](int64_t v) {
    const int row = static_cast<int>(v);
    for (int u = 0; u < grey.width(); ++u) {
      GreySample& sample = samples(u, row);
      sample.value = grey(u, row);
      if (u == 0 || row == 0 || u + 1 == grey.width() || row + 1 == grey.height()) continue;
      sample.du = 0.5f * (grey(u + 1, row) - grey(u - 1, row));
      sample.dv = 0.5f * (grey(u, row + 1) - grey(u, row - 1));
    }
  });
  return samples;
}

// The camera of an image divided by a whole number; what is left over at its end is cut off.
PinholeCamera DividedCamera(const PinholeCamera& camera, int divisor) {
  PinholeCamera divided = camera.Scaled(1.0 / divisor);
  divided.width = camera.width / divisor;
  divided.height = camera.height / divisor;
  return divided;
}

void AddGreyLevels(const ColorImage& color, const PinholeCamera& camera, int width,
                   TrackingFrame& frame) {
  const int divisor = DivisorForWidth(camera.width, width);
  Image<float> grey = ShrunkGrey(color, divisor);
  PinholeCamera level_camera = DividedCamera(camera, divisor);
  for (FrameLevel& level : frame.levels) {
    level.color_camera = level_camera;
    level.grey = WithGradient(grey);
    grey = HalvedGrey(grey);
    level_camera = DividedCamera(level_camera, 2);
  }
}

}  // namespace

PinholeCamera EveryNth(const PinholeCamera& camera, int n) {
  return {camera.width / n, camera.height / n, camera.fx / n,
          camera.fy / n,    camera.cx / n,     camera.cy / n};
}

TrackingCameras CamerasOf(const Sequence& sequence) {
  return {sequence.depth_camera, sequence.color_camera, sequence.T_color_depth};
}

DepthImage ReducedDepth(const DepthImage& depth, int divisor, double max_depth) {
  const int side = std::min(divisor, kMaxSquare);
  DepthImage reduced(depth.width() / divisor, depth.height() / divisor, 0);
  ParallelFor(0, reduced.height(), kBandRows, [&](int64_t v) {
    for (int u = 0; u < reduced.width(); ++u) {
      reduced(u, static_cast<int>(v)) = SquareDepth(
          depth, u * divisor, static_cast<int>(v) * divisor, side, static_cast<float>(max_depth));
    }
  });
  return reduced;
}

TrackingFrame MakeTrackingFrame(const DepthImage& depth, const ColorImage& color,
                                const TrackingCameras& cameras, const TrackingOptions& options) {
  TrackingFrame frame;
  frame.levels.resize(kTrackingLevels);
  const int divisor = DivisorForWidth(cameras.depth.width, options.image_width);
  frame.levels[0].depth = ReducedDepth(depth, divisor, options.max_depth);
  frame.levels[0].depth_camera = DividedCamera(cameras.depth, divisor);
  for (size_t i = 1; i < frame.levels.size(); ++i) {
    frame.levels[i].depth = EverySecond(frame.levels[i - 1].depth);
    frame.levels[i].depth_camera = EveryNth(frame.levels[i - 1].depth_camera, 2);
  }
  if (!color.empty()) AddGreyLevels(color, cameras.color, options.image_width, frame);
  return frame;
}

TrackingFrame MakeTrackingFrame(const SequenceFrame& stamps, const DepthImage& depth,
                                const ColorImage& color, const TrackingCameras& cameras,
                                const TrackingOptions& options) {
  TrackingFrame frame = MakeTrackingFrame(depth, color, cameras, options);
  frame.timestamp = stamps.timestamp;
  frame.color_delay = stamps.color_delay;
  return frame;
}

bool SampleGrey(const Image<GreySample>& grey, float u, float v, GreySample& sample) {
  if (!(u >= 1 && v >= 1 && u < static_cast<float>(grey.width() - 2) &&
        v < static_cast<float>(grey.height() - 2))) {
    return false;
  }
  const int u0 = static_cast<int>(u);
  const int v0 = static_cast<int>(v);
  const float x = u - static_cast<float>(u0);
  const float y = v - static_cast<float>(v0);
  const GreySample* upper = grey.row(v0) + u0;
  const GreySample* lower = grey.row(v0 + 1) + u0;
  const float w00 = (1 - x) * (1 - y), w10 = x * (1 - y), w01 = (1 - x) * y, w11 = x * y;
  sample.value =
      w00 * upper[0].value + w10 * upper[1].value + w01 * lower[0].value + w11 * lower[1].value;
  sample.du = w00 * upper[0].du + w10 * upper[1].du + w01 * lower[0].du + w11 * lower[1].du;
  sample.dv = w00 * upper[0].dv + w10 * upper[1].dv + w01 * lower[0].dv + w11 * lower[1].dv;
  return true;
}

}  // namespace curvefusion
