#pragma once

#include "kernel/geometry.h"

namespace curvefusion {

/// How far from the origin a coordinate may lie, in metres. Chosen: map projections reach 10^7 m
/// (northings of UTM), where doubles still tell 2 nm apart; squares and products of what lies
/// farther overflow in the end.
inline constexpr double kMaxCoordinate = 1e7;

/// Whether all coordinates are finite and at most kMaxCoordinate.
inline bool IsWithinBounds(const Vec3& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

/// What messages say of a point that is not within bounds.
inline constexpr const char* kOutOfBounds = "is not finite or more than 10,000 km from the origin";

}  // namespace curvefusion
