#include "tests/fusion/wire_images.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace curvefusion {

namespace {

constexpr int kRays = 5;  // along each side of a pixel

Eigen::Vector3f BackgroundColor(double u, double v) {
  const auto wave = static_cast<float>(12 * std::sin(u / 40) + 9 * std::cos(v / 30));
  return Eigen::Vector3f(120 + wave, 115 + wave, 130 + wave);
}

constexpr double kNowhere = 1e9;

// How far the nearest wire is that the ray from `origin` along `direction` hits, kNowhere where
// there is none, and its colour.
double HitWire(const std::vector<RenderedWire>& wires, const Vec3& origin, const Vec3& direction,
               Eigen::Vector3f& color) {
  double nearest = kNowhere;
  for (const RenderedWire& wire : wires) {
    const Vec3 axis = (wire.back - wire.front).normalized();
    const Vec3 normal = direction.cross(axis).normalized();
    const double offset = normal.dot(origin - wire.front);
    if (std::abs(offset) > 0.5 * wire.diameter) continue;
    // Nearest points of ray and axis.
    const double cosine = direction.dot(axis);
    const Vec3 between = wire.front - origin;
    const double depth =
        (between.dot(direction) - between.dot(axis) * cosine) / (1 - cosine * cosine);
    const double along = depth * cosine - between.dot(axis);
    if (along < 0 || along > (wire.back - wire.front).norm() || depth <= 0 || depth > nearest) {
      continue;
    }
    nearest = depth;
    const auto light = static_cast<float>(0.83 + 0.33 * offset / wire.diameter);
    color = light * Eigen::Vector3f(wire.color[0], wire.color[1], wire.color[2]);
  }
  return nearest;
}

ColorImage BlurAndRound(const cv::Mat& linear, double blur_px) {
  cv::Mat blurred;
  cv::GaussianBlur(linear, blurred, cv::Size(0, 0), blur_px);
  ColorImage image(linear.cols, linear.rows);
  cv::Mat rounded(linear.rows, linear.cols, CV_8UC3, image.data());
  blurred.convertTo(rounded, CV_8UC3);
  return image;
}

}  // namespace

ColorImage RenderWires(const std::vector<RenderedWire>& wires, const PinholeCamera& camera,
                       const RigidTransform& T_world_camera, double blur_px) {
  cv::Mat linear(camera.height, camera.width, CV_32FC3);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int ray = 0; ray < kRays * kRays; ++ray) {
        const double x = u + (ray % kRays + 0.5) / kRays - 0.5;
        const double y = v + (ray / kRays + 0.5) / kRays - 0.5;
        const Vec3 direction = T_world_camera.linear() * camera.Unproject(x, y, 1).normalized();
        Eigen::Vector3f color = BackgroundColor(x, y);
        HitWire(wires, T_world_camera.translation(), direction, color);
        sum += color;
      }
      sum /= kRays * kRays;
      linear.at<cv::Vec3f>(v, u) = cv::Vec3f(sum[0], sum[1], sum[2]);
    }
  }
  return BlurAndRound(linear, blur_px);
}

DepthImage RenderWireDepth(const std::vector<RenderedWire>& wires, const PinholeCamera& camera,
                           const RigidTransform& T_world_camera, double fattening_px) {
  std::vector<RenderedWire> fat = wires;
  for (RenderedWire& wire : fat) {
    const double depth = (T_world_camera.inverse() * (0.5 * (wire.front + wire.back))).z();
    wire.diameter += 2 * fattening_px * depth / camera.fx;
  }
  DepthImage image(camera.width, camera.height, 1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vec3 ray = camera.Unproject(u, v, 1);
      Eigen::Vector3f color;
      const double distance = HitWire(fat, T_world_camera.translation(),
                                      T_world_camera.linear() * ray.normalized(), color);
      if (distance < kNowhere) image(u, v) = static_cast<float>(distance / ray.norm());
    }
  }
  return image;
}

ColorImage DrawStrip(int width, int height, double left, double right, const Rgb& strip,
                     const Rgb& background, double blur_px) {
  cv::Mat linear(height, width, CV_32FC3);
  for (int u = 0; u < width; ++u) {
    const double cover = std::clamp(std::min(u + 0.5, right) - std::max(u - 0.5, left), 0.0, 1.0);
    cv::Vec3f color;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      color[k] = static_cast<float>(background[i] + cover * (strip[i] - background[i]));
    }
    for (int v = 0; v < height; ++v) linear.at<cv::Vec3f>(v, u) = color;
  }
  return BlurAndRound(linear, blur_px);
}

void WriteImage(const std::filesystem::path& path, ColorImage image) {
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(image.height(), image.width(), CV_8UC3, image.data()), bgr,
               cv::COLOR_RGB2BGR);
  cv::imwrite(path.string(), bgr);
}

}  // namespace curvefusion
