#include "capture/distortion.h"

#include <algorithm>
#include <cmath>

namespace curvefusion {

namespace {

constexpr int kRadiusSteps = 200;  // chosen: half a percent of the radius
constexpr int kShiftSteps = 16;    // chosen: the shift varies slowly over the image

// Calls see(u, v, seen) for each pixel of the ideal image with the place where it was seen.
template <class See>
void ForEachSeen(const PinholeCamera& camera, const Distortion& distortion, const See& see) {
  const double limit = distortion.ValidRadius(CornerRadius(camera));
  for (int v = 0; v < camera.height; ++v) {
    const double y = (v - camera.cy) / camera.fy;
    for (int u = 0; u < camera.width; ++u) {
      const Vec2 ray((u - camera.cx) / camera.fx, y);
      if (ray.squaredNorm() > limit * limit) continue;
      const Vec2 bent = distortion.Apply(ray);
      const Vec2 seen(camera.fx * bent.x() + camera.cx, camera.fy * bent.y() + camera.cy);
      if (camera.Contains(seen)) see(u, v, seen);
    }
  }
}

Rgb Interpolated(const ColorImage& image, const Vec2& pixel) {
  const double x = std::clamp(pixel.x(), 0.0, image.width() - 1.0);
  const double y = std::clamp(pixel.y(), 0.0, image.height() - 1.0);
  const int u = static_cast<int>(x), v = static_cast<int>(y);
  const int right = std::min(u + 1, image.width() - 1), below = std::min(v + 1, image.height() - 1);
  const double a = x - u, b = y - v;
  Rgb color;
  for (size_t k = 0; k < color.size(); ++k) {
    const double upper = (1 - a) * image(u, v)[k] + a * image(right, v)[k];
    const double lower = (1 - a) * image(u, below)[k] + a * image(right, below)[k];
    color[k] = static_cast<uint8_t>((1 - b) * upper + b * lower + 0.5);
  }
  return color;
}

}  // namespace

Vec2 Distortion::Apply(const Vec2& ray) const {
  const double x = ray.x(), y = ray.y();
  const double r2 = x * x + y * y;
  double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  if (IsRational()) radial /= 1 + r2 * (k4 + r2 * (k5 + r2 * k6));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

double Distortion::ValidRadius(double max_radius) const {
  for (int i = 0; i <= kRadiusSteps; ++i) {
    const double r = max_radius * i / kRadiusSteps;
    const double r2 = r * r;
    const double numerator = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double denominator = 1 + r2 * (k4 + r2 * (k5 + r2 * k6));
    // The slope of r numerator / denominator, times denominator^2.
    const double slope = (1 + r2 * (3 * k1 + r2 * (5 * k2 + r2 * 7 * k3))) * denominator -
                         numerator * r2 * (2 * k4 + r2 * (4 * k5 + r2 * 6 * k6));
    if (!(slope > 0 && denominator > 0)) return max_radius * std::max(0, i - 1) / kRadiusSteps;
  }
  return max_radius;
}

double CornerRadius(const PinholeCamera& camera) {
  const double x = std::max(camera.cx + 0.5, camera.width - 0.5 - camera.cx) / camera.fx;
  const double y = std::max(camera.cy + 0.5, camera.height - 0.5 - camera.cy) / camera.fy;
  return std::hypot(x, y);
}

double LargestShift(const PinholeCamera& camera, const Distortion& distortion) {
  const double limit = distortion.ValidRadius(CornerRadius(camera));
  double largest = 0;
  for (int i = 0; i <= kShiftSteps; ++i) {
    for (int k = 0; k <= kShiftSteps; ++k) {
      const Vec2 ray = camera
                           .Unproject((camera.width - 1.0) * i / kShiftSteps,
                                      (camera.height - 1.0) * k / kShiftSteps, 1)
                           .head<2>();
      if (ray.norm() > limit) continue;
      const Vec2 moved = distortion.Apply(ray) - ray;
      largest = std::max(largest, std::hypot(camera.fx * moved.x(), camera.fy * moved.y()));
    }
  }
  return largest;
}

DepthImage Undistorted(const DepthImage& image, const PinholeCamera& camera,
                       const Distortion& distortion) {
  DepthImage ideal(image.width(), image.height(), 0);
  ForEachSeen(camera, distortion, [&](int u, int v, const Vec2& seen) {
    const Eigen::Vector2i pixel = PinholeCamera::Rounded(seen);
    ideal(u, v) = image(pixel.x(), pixel.y());
  });
  return ideal;
}

ColorImage Undistorted(const ColorImage& image, const PinholeCamera& camera,
                       const Distortion& distortion) {
  ColorImage ideal(image.width(), image.height(), Rgb{0, 0, 0});
  ForEachSeen(camera, distortion,
              [&](int u, int v, const Vec2& seen) { ideal(u, v) = Interpolated(image, seen); });
  return ideal;
}

}  // namespace curvefusion
