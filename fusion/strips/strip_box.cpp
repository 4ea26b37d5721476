#include "fusion/strips/strip_box.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "capture/image_mat.h"

namespace curvefusion {

namespace {

// Of a 3x3 Sobel gradient of 8-bit values. Chosen, as CurveFusion 4.3 names no thresholds.
constexpr double kCannyLow = 50;
constexpr double kCannyHigh = 100;
// Cosine between the directions of facing edges. Chosen: 30 degrees.
constexpr double kMinParallel = 0.87;
// Derived: more than the diagonal of a pixel, as the neighbour on the same edge is no facing edge.
constexpr double kMinWidthPx = 1.5;

struct Edges {
  cv::Mat mask;  // 8-bit, 0 or 255
  cv::Mat dx;    // 16-bit, of the channel that changes most
  cv::Mat dy;
};

Edges ExtractEdges(const ColorImage& image) {
  const cv::Mat rgb = MatOf(image);
  cv::Mat dx;
  cv::Mat dy;
  cv::Sobel(rgb, dx, CV_16S, 1, 0);
  cv::Sobel(rgb, dy, CV_16S, 0, 1);
  Edges edges{{}, cv::Mat(rgb.size(), CV_16S), cv::Mat(rgb.size(), CV_16S)};
  for (int v = 0; v < rgb.rows; ++v) {
    for (int u = 0; u < rgb.cols; ++u) {
      const cv::Vec3s x = dx.at<cv::Vec3s>(v, u);
      const cv::Vec3s y = dy.at<cv::Vec3s>(v, u);
      int strongest = 0;
      for (int k = 1; k < 3; ++k) {
        const int norm = std::abs(x[k]) + std::abs(y[k]);
        if (norm > std::abs(x[strongest]) + std::abs(y[strongest])) strongest = k;
      }
      edges.dx.at<short>(v, u) = x[strongest];
      edges.dy.at<short>(v, u) = y[strongest];
    }
  }
  cv::Canny(edges.dx, edges.dy, edges.mask, kCannyLow, kCannyHigh, true);
  return edges;
}

Vec2 GradientDirection(const Edges& edges, int u, int v) {
  return Vec2(edges.dx.at<short>(v, u), edges.dy.at<short>(v, u)).normalized();
}

// Walks from an edge pixel along `direction` to the next edge; where that is parallel, marks the
// way as the inside of a strip and its middle as axis.
void MarkStrip(const Edges& edges, int u, int v, const Vec2& direction, int max_width_px,
               StripRegions& regions) {
  std::vector<std::pair<int, int>> across;
  for (int step = 1; step <= max_width_px; ++step) {
    const int x = static_cast<int>(std::lround(u + step * direction.x()));
    const int y = static_cast<int>(std::lround(v + step * direction.y()));
    if (!regions.inside.Contains(x, y)) return;
    if (edges.mask.at<uint8_t>(y, x) == 0) {
      across.emplace_back(x, y);
      continue;
    }
    const double width = std::hypot(x - u, y - v);
    if (width < kMinWidthPx) continue;
    if (std::abs(GradientDirection(edges, x, y).dot(direction)) < kMinParallel) return;
    for (const auto& [a, b] : across) regions.inside(a, b) = 1;
    if (!across.empty()) {
      const auto& [a, b] = across[across.size() / 2];
      regions.axis_width(a, b) = static_cast<float>(width);
    }
    return;
  }
}

// Number of 4-connected regions of the inside within [u0, u1) x [v0, v1).
int CountRegions(const StripRegions& regions, int u0, int v0, int u1, int v1) {
  const int width = u1 - u0;
  std::vector<uint8_t> is_open(static_cast<size_t>(width) * (v1 - v0));
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u) is_open[(v - v0) * width + u - u0] = regions.inside(u, v);
  }
  int count = 0;
  std::vector<int> stack;
  for (int seed = 0; seed < static_cast<int>(is_open.size()); ++seed) {
    if (!is_open[seed]) continue;
    ++count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const int i = stack.back();
      stack.pop_back();
      if (!is_open[i]) continue;
      is_open[i] = 0;
      const int u = i % width;
      if (u > 0) stack.push_back(i - 1);
      if (u + 1 < width) stack.push_back(i + 1);
      if (i >= width) stack.push_back(i - width);
      if (i + width < static_cast<int>(is_open.size())) stack.push_back(i + width);
    }
  }
  return count;
}

}  // namespace

StripRegions LabelStrips(const ColorImage& image, int max_width_px) {
  const Edges edges = ExtractEdges(image);
  StripRegions regions{MaskImage(image.width(), image.height()),
                       Image<float>(image.width(), image.height())};
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      if (edges.mask.at<uint8_t>(v, u) == 0) continue;
      const Vec2 direction = GradientDirection(edges, u, v);
      MarkStrip(edges, u, v, direction, max_width_px, regions);
      MarkStrip(edges, u, v, -direction, max_width_px, regions);
    }
  }
  return regions;
}

double StripWidthInBox(const StripRegions& regions, const Vec2& center, int box_size_px) {
  const int u0 = static_cast<int>(std::lround(center.x() - 0.5 * box_size_px));
  const int v0 = static_cast<int>(std::lround(center.y() - 0.5 * box_size_px));
  const int u1 = u0 + box_size_px;
  const int v1 = v0 + box_size_px;
  if (u0 < 0 || v0 < 0 || u1 > regions.inside.width() || v1 > regions.inside.height()) return 0;
  if (CountRegions(regions, u0, v0, u1, v1) != 1) return 0;
  double sum = 0;
  int count = 0;
  for (int v = v0; v < v1; ++v) {
    for (int u = u0; u < u1; ++u) {
      const float width = regions.axis_width(u, v);
      sum += width;
      count += width > 0 ? 1 : 0;
    }
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace curvefusion
