#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "meshing/tube_axis.h"

namespace curvefusion {

/// A closed polygon about the axis of a tube: its corners are centre + offsets.
struct Ring {
  Vec3 centre;
  double radius = 0;  ///< of the tube, m
  std::vector<Vec3> offsets;
};

/// How far a ray (unit vector) from a point runs within balls; 0 where it meets none. Linear.
double ExtentOfBalls(const TubeAxis& balls, const Vec3& from, const Vec3& ray);

/// The ring with every corner moved, along the ray from the centre, to where that leaves the balls,
/// or as far as `greatest` (m).
Ring OntoBalls(Ring ring, const TubeAxis& balls, double greatest);

/// Balls stand out of a tube along their smooth axis by no more, in radii.
inline constexpr double kGreatestExtent = 1.1;

/// The fewest rings between two that follow the surface of balls within .003 radii. Their corners
/// lie on rays from `first` turning evenly into those from `last`, two rings of the tube's axis
/// that do not cross. `shaped_first` and `shaped_last` are the same as they will be swept. O(length
/// times corners times balls).
std::vector<Ring> RingsBetween(const Ring& first, const Ring& last, const Ring& shaped_first,
                               const Ring& shaped_last, const TubeAxis& balls);

}  // namespace curvefusion
