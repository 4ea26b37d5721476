#pragma once

#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// Lens distortion by Brown and Conrady, with the coefficients of OpenCV. A ray (x, y, 1) is seen
/// where an ideal camera would see (x', y', 1):
/// x' = x s + 2 p1 x y + p2 (r^2 + 2 x^2), r^2 = x^2 + y^2,
/// y' = y s + p1 (r^2 + 2 y^2) + 2 p2 x y,
/// s = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6).
struct Distortion {
  double k1 = 0;
  double k2 = 0;
  double p1 = 0;
  double p2 = 0;
  double k3 = 0;
  double k4 = 0;
  double k5 = 0;
  double k6 = 0;

  bool IsRational() const { return k4 != 0 || k5 != 0 || k6 != 0; }
  bool IsZero() const {
    return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0 && !IsRational();
  }
  Vec2 Apply(const Vec2& ray) const;
  /// The largest r up to `max_radius` to which the model goes outwards with r; beyond it the same
  /// place would be seen twice.
  double ValidRadius(double max_radius) const;
};

/// The largest r of a camera's image, at one of its corners.
double CornerRadius(const PinholeCamera& camera);

/// The farthest that the distortion moves a pixel of the image, in pixels.
double LargestShift(const PinholeCamera& camera, const Distortion& distortion);

/// The image that a camera without distortion would have taken, with the same intrinsics: each
/// pixel has the value nearest to where it was seen, so that no depth between near and far things
/// comes up; what was not seen is 0. The image has the camera's size. About 3 ms for 640x480.
DepthImage Undistorted(const DepthImage& image, const PinholeCamera& camera,
                       const Distortion& distortion);

/// The same for colours, interpolated between four pixels; what was not seen is black.
ColorImage Undistorted(const ColorImage& image, const PinholeCamera& camera,
                       const Distortion& distortion);

}  // namespace curvefusion
