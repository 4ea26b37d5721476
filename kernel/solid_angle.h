#pragma once

#include <cmath>

#include "kernel/geometry.h"

namespace curvefusion {

/// The solid angle under which a triangle is seen from the origin; positive if its back is seen, as
/// from inside of a closed surface, where the sum is 4 pi (van Oosterom and Strackee 1983).
inline double SolidAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double x = a.norm(), y = b.norm(), z = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
}

}  // namespace curvefusion
