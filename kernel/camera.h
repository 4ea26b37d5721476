#pragma once

#include <cmath>

#include "kernel/geometry.h"

namespace curvefusion {

/// A pinhole camera looking along +z, x right, y down. Pixel (0, 0) is the centre of the top-left
/// pixel. Focal lengths and principal point in pixels.
struct PinholeCamera {
  /// Metres along z. Chosen: scans are taken from farther away, so nothing nearer is projected.
  static constexpr double kNearest = 0.05;
  /// Likewise of a box of which bounds are asked. Chosen: at 0 pixels have none.
  static constexpr double kNearestBox = 1e-3;

  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;

  /// Pixel of a point in the camera frame; z must be positive.
  Vec2 Project(const Vec3& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }

  /// Where a box along the camera's axes is seen; low.z() must be positive.
  Eigen::AlignedBox2d BoundsOfBox(const Vec3& low, const Vec3& high) const {
    // The least x is seen farthest left from near when negative, from afar when positive.
    const double left = low.x() / (low.x() < 0 ? low.z() : high.z());
    const double right = high.x() / (high.x() > 0 ? low.z() : high.z());
    const double top = low.y() / (low.y() < 0 ? low.z() : high.z());
    const double bottom = high.y() / (high.y() > 0 ? low.z() : high.z());
    return {Vec2(fx * left + cx, fy * top + cy), Vec2(fx * right + cx, fy * bottom + cy)};
  }

  /// Point in the camera frame at a pixel and a depth along the optical axis (metres).
  Vec3 Unproject(double u, double v, double depth) const {
    return {(u - cx) / fx * depth, (v - cy) / fy * depth, depth};
  }

  /// Whether a pixel rounds into the image.
  bool Contains(const Vec2& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 &&
           pixel.y() < height - 0.5;
  }

  /// The pixel that a place in the image rounds to; it lies in the image where Contains says so.
  static Eigen::Vector2i Rounded(const Vec2& pixel) {
    return (pixel.array() + 0.5).floor().cast<int>();
  }

  /// The same camera with an image `factor` times as large (0.5: half width and height).
  PinholeCamera Scaled(double factor) const {
    return {static_cast<int>(std::lround(width * factor)),
            static_cast<int>(std::lround(height * factor)),
            fx * factor,
            fy * factor,
            (cx + 0.5) * factor - 0.5,
            (cy + 0.5) * factor - 0.5};
  }
};

}  // namespace curvefusion
