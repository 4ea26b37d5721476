#pragma once

#include <array>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/triangle_mesh.h"
#include "meshing/tube_paths.h"

namespace curvefusion {

/// Vertices lie off flat facets at random by so many radii, a thousandth of what can be printed:
/// rounding to float32 alone puts them off by about the tolerance of programs that look for
/// self-intersections in floating point (Open3D's is_watertight), which then take some triangles of
/// one facet for crossing.
inline constexpr double kSurfaceRoughness = 1e-4;

/// The vertices of a tube before it is triangulated: rings of `sides` vertices each, in order along
/// the tube, then the poles of rounded ends. Rounded to float32 here, once: all that follows works
/// on the coordinates that are written to the file.
struct TubeRings {
  int sides = 0;
  int ring_count = 0;
  bool closed = false;
  std::vector<Vec3f> vertices;       ///< ring_count * sides, then up to two poles
  std::vector<int> ring_of_point;    ///< the ring at each point of the axis
  std::array<int, 2> poles{-1, -1};  ///< indices into vertices; -1 where the end is flat
};

/// Rotation-minimising frames along a path: a unit normal to the tangent at every point, by double
/// reflection (Wang, Juettler, Zheng, Liu 2008). On a closed path the remaining twist is spread
/// evenly.
std::vector<Vec3> RotationMinimisingNormals(const TubePath& path);

/// The rings of a path: at every point of the axis a regular polygon of the circle's area, mitred
/// to the bisecting plane; rounded ends get a hemisphere, flat ones that are thinner than the tube
/// a short taper. `phase` turns all rings about the axis (radians). Segments of which `balls` holds
/// any (empty for none at all) get more rings, which have the shape of the balls
/// (FindRoughStretches).
TubeRings SweepRings(const TubePath& path, int sides, double phase,
                     const std::vector<TubeAxis>& balls = {});

}  // namespace curvefusion
