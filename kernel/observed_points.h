#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Points measured on thin structures, with what is known of how they were seen. The three arrays
/// have the same length. Clouds without sensor information have zero rays and counts of 1.
struct ObservedPoints {
  std::vector<Vec3> positions;     ///< metres
  std::vector<Vec3> viewing_rays;  ///< mean unit direction from the camera to the point, or zero
  std::vector<float> counts;       ///< number of depth pixels merged into the point

  size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
  void Reserve(size_t n) {
    positions.reserve(n);
    viewing_rays.reserve(n);
    counts.reserve(n);
  }
  void Resize(size_t n) {
    positions.resize(n);
    viewing_rays.resize(n);
    counts.resize(n);
  }
  void Add(const Vec3& position, const Vec3& viewing_ray, float count) {
    positions.push_back(position);
    viewing_rays.push_back(viewing_ray);
    counts.push_back(count);
  }
  /// Adds point `i` of others.
  void Add(const ObservedPoints& others, size_t i) {
    Add(others.positions[i], others.viewing_rays[i], others.counts[i]);
  }
};

/// The points after a motion or another affine map; rays are mapped as directions.
ObservedPoints Transformed(const ObservedPoints& points, const AffineTransform& T);

/// Adds `more` behind `points`.
void Append(ObservedPoints& points, const ObservedPoints& more);

/// Sides of the box that leaves out a hundredth of the points to either side of each axis, so that
/// outliers do not count; zero for no points.
Vec3 RobustExtent(const ObservedPoints& points);

/// Throws Error(kBadInput) naming the first point whose position is not finite.
void RequireFinitePositions(const ObservedPoints& points);

}  // namespace curvefusion
