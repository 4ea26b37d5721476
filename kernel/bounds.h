#pragma once

#include "kernel/geometry.h"

namespace curvefusion {

/// How far from the origin coordinates in files may lie, in metres. Chosen: map projections reach
/// 10^7 m (northings of UTM), where doubles still tell 2 nm apart.
inline constexpr double kMaxCoordinate = 1e7;

/// The same for what is computed with, derived: products of five stay finite, as many as the exact
/// decisions on distances multiply.
inline constexpr double kMaxComputable = 1e60;

/// Whether all coordinates are finite and at most `limit`.
inline bool IsWithinBounds(const Vec3& p, double limit) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= limit;
}

}  // namespace curvefusion
