#include "fusion/segmentation/colour_verification.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int64_t kRowsPerChunk = 16;  // chosen: a task of some 10,000 pixels

// For every pixel the Sobel gradient of the channel in which it is strongest.
void StrongestGradient(const cv::Mat& rgb, cv::Mat& dx, cv::Mat& dy) {
  cv::Mat smoothed, dx3, dy3;
  cv::GaussianBlur(rgb, smoothed, cv::Size(5, 5), 1.0);
  cv::Sobel(smoothed, dx3, CV_16S, 1, 0);
  cv::Sobel(smoothed, dy3, CV_16S, 0, 1);
  dx.create(rgb.size(), CV_16S);
  dy.create(rgb.size(), CV_16S);
  for (int v = 0; v < rgb.rows; ++v) {
    const cv::Vec3s* x3 = dx3.ptr<cv::Vec3s>(v);
    const cv::Vec3s* y3 = dy3.ptr<cv::Vec3s>(v);
    for (int u = 0; u < rgb.cols; ++u) {
      int strongest = 0;
      for (int c = 1; c < 3; ++c) {
        const auto strength = [&](int k) { return std::abs(x3[u][k]) + std::abs(y3[u][k]); };
        if (strength(c) > strength(strongest)) strongest = c;
      }
      dx.ptr<int16_t>(v)[u] = x3[u][strongest];
      dy.ptr<int16_t>(v)[u] = y3[u][strongest];
    }
  }
}

MaskImage Dilated(const MaskImage& mask, double radius_px) {
  const int radius = static_cast<int>(std::lround(radius_px));
  if (radius < 1) return mask;
  MaskImage dilated(mask.width(), mask.height());
  const cv::Size size(2 * radius + 1, 2 * radius + 1);
  cv::dilate(MatOf(mask), MatOf(dilated), cv::getStructuringElement(cv::MORPH_ELLIPSE, size));
  return dilated;
}

}  // namespace

MaskImage ColourEdges(const ColorImage& color, const CannyThresholds& thresholds) {
  const cv::Mat rgb = MatOf(color);
  cv::Mat dx, dy, edges;
  StrongestGradient(rgb, dx, dy);
  cv::Canny(dx, dy, edges, thresholds.low, thresholds.high, true);
  MaskImage mask(color.width(), color.height());
  for (int v = 0; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) mask(u, v) = edges.at<uint8_t>(v, u) != 0;
  }
  return mask;
}

MaskImage MaskPixelsOnEdges(const MaskImage& mask, const DepthImage& depth, const MaskImage& edges,
                            const PinholeCamera& depth_camera, const PinholeCamera& color_camera,
                            const RigidTransform& T_color_depth, double tolerance_px) {
  const MaskImage near_edges = Dilated(edges, tolerance_px);
  MaskImage on_edge(depth.width(), depth.height(), 0);
  ParallelFor(0, depth.height(), kRowsPerChunk, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < depth.width(); ++u) {
      if (!mask(u, v)) continue;
      const Vec3 p_color = T_color_depth * depth_camera.Unproject(u, v, depth(u, v));
      if (p_color.z() <= 0) continue;
      const Vec2 pixel = color_camera.Project(p_color);
      if (!color_camera.Contains(pixel)) continue;
      const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
      on_edge(u, v) = near_edges(at.x(), at.y());
    }
  });
  return on_edge;
}

}  // namespace curvefusion
