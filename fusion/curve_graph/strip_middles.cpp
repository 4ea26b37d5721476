#include "fusion/curve_graph/strip_middles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "capture/image_mat.h"
#include "kernel/quantile.h"
#include "kernel/wide_lanes.h"

namespace curvefusion {

namespace {

// Chosen like those of colour_candidates.cpp.
constexpr uint8_t kNotWire = 110;   // of 255: pixels less likely to show wire surely do not
constexpr double kMinContrast = 7;  // grey levels, to both sides of a strip
constexpr double kBlurPx = 0.8;
constexpr double kOutstanding = 3;  // standard deviations of what images show anyway
constexpr int kAlongPx = 5;
constexpr int kTensorPx = 3;  // to all sides of a middle, where gradients tell how a strip runs
constexpr int kReachesPx[] = {3, 5, 8};  // from the middle of a strip to what is beside it

// The three channels of an image, smoothed, one after the other.
using Planes = std::array<Image<float>, 3>;

Planes SmoothPlanes(const ColorImage& color) {
  const cv::Mat pixels = MatOf(color);
  cv::Mat smooth;
  cv::GaussianBlur(pixels, smooth, cv::Size(5, 5), kBlurPx);
  Planes planes;
  std::array<cv::Mat, 3> targets;
  for (int c = 0; c < 3; ++c) {
    planes[c] = Image<float>(color.width(), color.height());
    cv::Mat channel;
    cv::extractChannel(smooth, channel, c);
    targets[c] = MatOf(planes[c]);
    channel.convertTo(targets[c], CV_32F);
  }
  return planes;
}

// Of a row of each plane.
CURVEFUSION_WIDE_LANES
void RespondInRow(const std::array<const float*, 3>& planes, std::ptrdiff_t offset, int begin,
                  int end, float* response) {
  const auto [r, g, b] = planes;
  for (int u = begin; u < end; ++u) {
    response[u] = (r[u] - r[u - offset]) * (r[u] - r[u + offset]) +
                  (g[u] - g[u - offset]) * (g[u] - g[u + offset]) +
                  (b[u] - b[u - offset]) * (b[u] - b[u + offset]);
  }
}

// How much a pixel differs from both sides alike, at so many pixels in one direction: grey levels.
Image<float> StripResponse(const Planes& planes, int du, int dv) {
  const int width = planes[0].width(), height = planes[0].height();
  const int margin = std::max(std::abs(du), std::abs(dv));
  Image<float> response(width, height, 0);
  const std::ptrdiff_t offset = static_cast<std::ptrdiff_t>(dv) * width + du;
  for (int v = margin; v < height - margin; ++v) {
    RespondInRow({planes[0].row(v), planes[1].row(v), planes[2].row(v)}, offset, margin,
                 width - margin, response.row(v));
  }
  return response;
}

CURVEFUSION_WIDE_LANES
void AddRow(const float* in, float weight, int begin, int end, float* sums) {
  for (int u = begin; u < end; ++u) sums[u] += weight * in[u];
}

CURVEFUSION_WIDE_LANES
void SlideRow(const float* before, const float* added, const float* dropped, float weight,
              int begin, int end, float* sums) {
  for (int u = begin; u < end; ++u) sums[u] = before[u] + weight * (added[u] - dropped[u]);
}

// The mean over some pixels to both sides in one direction (dv is 1, or du is): along strips noise
// averages out. From row to row each sum follows from the one before it.
Image<float> AveragedAlong(const Image<float>& image, int du, int dv) {
  const int width = image.width(), height = image.height();
  constexpr int kLength = 2 * kAlongPx + 1;
  constexpr float kWeight = 1.0F / kLength;
  const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(dv) * width + du;
  Image<float> mean(width, height, 0);
  const int first = kAlongPx + 1, last = width - first;
  for (int v = first; v < height - first; ++v) {
    float* out = mean.row(v);
    const float* in = image.row(v);
    const auto add_all = [&](int begin, int end) {
      for (int k = -kAlongPx; k <= kAlongPx; ++k) AddRow(in + k * step, kWeight, begin, end, out);
    };
    if (dv == 0 || v == first) {
      add_all(first, last);
      continue;
    }
    const int begin = std::max(first, first + du), end = std::min(last, last + du);
    add_all(first, begin);
    SlideRow(out - step, in + kAlongPx * step, in - (kAlongPx + 1) * step, kWeight, begin, end,
             out);
    add_all(end, last);
  }
  return mean;
}

// What stands out among the values of an image: noise alone makes responses, its own square.
float Outstanding(const Image<float>& response) {
  constexpr size_t kEvery = 61;  // chosen: a hundredth of the spread
  std::vector<double> values;
  for (size_t i = 0; i < response.size(); i += kEvery) values.push_back(response.data()[i]);
  const double usual = Median(values);
  for (double& value : values) value -= usual;
  const double spread = RobustDeviation(std::move(values));
  return static_cast<float>(usual + std::max(kMinContrast * kMinContrast, kOutstanding * spread));
}

// Where a response is large and the largest across a strip.
CURVEFUSION_WIDE_LANES
void MarkRow(const float* response, std::ptrdiff_t across, float least, const uint8_t* posterior,
             int begin, int end, uint8_t* middles) {
  for (int u = begin; u < end; ++u) {
    middles[u] |= (response[u] >= least) & (response[u] >= response[u - across]) &
                  (response[u] >= response[u + across]) & (posterior[u] > kNotWire);
  }
}

MaskImage StripMiddles(const Planes& planes, const PosteriorImage& posterior) {
  // Derived: the four directions between neighbouring pixels, across strips and along them.
  constexpr std::pair<std::pair<int, int>, std::pair<int, int>> kDirections[] = {
      {{1, 0}, {0, 1}}, {{0, 1}, {1, 0}}, {{1, 1}, {-1, 1}}, {{1, -1}, {1, 1}}};
  const int width = posterior.width(), height = posterior.height();
  MaskImage middles(width, height, 0);
  for (const int reach : kReachesPx) {
    for (const auto& [across_strip, along] : kDirections) {
      const auto [du, dv] = across_strip;
      const int step = du != 0 && dv != 0 ? static_cast<int>(std::lround(0.7 * reach)) : reach;
      const Image<float> response =
          AveragedAlong(StripResponse(planes, step * du, step * dv), along.first, along.second);
      const float least = Outstanding(response);
      const std::ptrdiff_t across = static_cast<std::ptrdiff_t>(dv) * width + du;
      for (int v = step; v + step < height; ++v)
        MarkRow(response.row(v), across, least, posterior.row(v), step, width - step,
                middles.row(v));
    }
  }
  return middles;
}

Image<uint8_t> StripDirections(const Planes& planes, const MaskImage& middles) {
  Image<uint8_t> directions(middles.width(), middles.height(), 0);
  for (int v = kTensorPx + 1; v + kTensorPx + 1 < middles.height(); ++v) {
    for (int u = kTensorPx + 1; u + kTensorPx + 1 < middles.width(); ++u) {
      if (!middles(u, v)) continue;
      double xx = 0, xy = 0, yy = 0;
      for (const Image<float>& plane : planes) {
        for (int b = v - kTensorPx; b <= v + kTensorPx; ++b) {
          for (int a = u - kTensorPx; a <= u + kTensorPx; ++a) {
            const double x = plane(a + 1, b) - plane(a - 1, b);
            const double y = plane(a, b + 1) - plane(a, b - 1);
            xx += x * x;
            xy += x * y;
            yy += y * y;
          }
        }
      }
      // The gradients' own direction is at half the angle of the tensor's; strips run across it.
      const double across = 0.5 * std::atan2(2 * xy, xx - yy);
      directions(u, v) = DirectionUnits(across + 0.5 * M_PI);
    }
  }
  return directions;
}

}  // namespace

uint8_t DirectionUnits(double angle) {
  const double turns = angle / M_PI;
  return static_cast<uint8_t>(static_cast<int>(256 * (turns - std::floor(turns))) & 255);
}

StripPixels FindStripPixels(const ColorImage& color, const PosteriorImage& posterior) {
  const Planes planes = SmoothPlanes(color);
  MaskImage middles = StripMiddles(planes, posterior);
  Image<uint8_t> directions = StripDirections(planes, middles);
  return {std::move(middles), std::move(directions)};
}

}  // namespace curvefusion
