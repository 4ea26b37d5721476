#pragma once

#include <cstddef>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Points on the one-dimensional ridges of a density, about evenly spaced. Arrays of one length.
struct RidgePoints {
  std::vector<Vec3> positions;    ///< metres
  std::vector<Vec3> directions;   ///< unit tangents of the ridge, of either sign
  std::vector<double> strengths;  ///< kernel-weighted number of observations around the point
  std::vector<int> levels;        ///< of the kernel's width, 0 the thinnest

  size_t size() const { return positions.size(); }
};

/// The indices of points, the strongest first, without those nearer than `spacing` to a stronger
/// one that stays. Arrays of one length.
std::vector<int> StrongestApart(const std::vector<Vec3>& positions,
                                const std::vector<double>& strengths, double spacing);

/// The ridge points of both; of those nearer than `spacing` to each other the strongest.
RidgePoints Merged(const RidgePoints& a, const RidgePoints& b, double spacing);

RidgePoints Transformed(RidgePoints ridge, const RigidTransform& T);

}  // namespace curvefusion
