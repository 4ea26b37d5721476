#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Points of a result or a truth, as they are aligned.
struct AlignmentPoints {
  std::vector<Vec3> positions;
  std::vector<Vec3> tangents;  ///< of the curves through them, unit length; empty for surfaces
};

/// About `count` elements, evenly picked; all where there are no more.
template <class T>
std::vector<T> Thinned(const std::vector<T>& all, size_t count) {
  const size_t step = (all.size() + count - 1) / count;
  std::vector<T> thinned;
  for (size_t i = 0; i < all.size(); i += step) thinned.push_back(all[i]);
  return thinned;
}
AlignmentPoints Thinned(const AlignmentPoints& points, size_t count);

/// Where points (some) lie, and how far from there in the root mean square, 1 mm at least.
struct PointSpread {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};
PointSpread SpreadOfPoints(const std::vector<Vec3>& points);

/// The turn about a point by a rotation vector (axis times angle).
RigidTransform TurnAbout(const Vec3& center, const Vec3& rotation_vector);

}  // namespace curvefusion
