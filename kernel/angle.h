#pragma once

#include <cmath>
#include <numbers>

#include "kernel/geometry.h"

namespace curvefusion {

/// Every angle without a unit suffix is in radians; this converts what people read and write.
inline constexpr double kDegree = std::numbers::pi / 180;

/// The angle between two directions of any length above 0, from 0 to pi.
inline double AngleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace curvefusion
