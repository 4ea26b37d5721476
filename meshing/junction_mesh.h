#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// Tubes that touch, cut off where they are clear of each other.
struct Junction {
  std::vector<TriangleMesh> stubs;            ///< closed; cut ends are flat discs over a ring
  std::vector<std::vector<Vec3f>> cut_rings;  ///< the vertices of those rings
  double radius = 0;                          ///< of the thinnest tube
};

/// What takes the place of a union that does not come out.
enum class LastResort {
  kNone,
  kWrapping,    ///< WrapJunction
  kResampling,  ///< ResampleJunction
};

/// The surface of a junction, open at its cut rings.
struct JunctionMesh {
  std::optional<TriangleMesh> surface;         ///< nothing where every attempt failed
  int attempts = 0;                            ///< how many it took
  LastResort last_resort = LastResort::kNone;  ///< that gave it
};

/// What is done about a junction that does not come out.
struct JunctionMeshOptions {
  int max_attempts = 8;      ///< >= 0
  bool last_resort = false;  ///< then take another surface
};

/// Unites the stubs of a junction exactly, cleans and rounds the union, checks that it is
/// free of self-intersections in metres and in millimetres, and opens it at the cut rings, whose
/// vertices stay in place. Where something fails it tries again with the other vertices moved by a
/// few thousandths of the radius and a coarser cleaning. Of more than 16 stubs it makes fewer
/// attempts, of 40 and more that are not short at most one, and then takes the last resort unasked:
/// where surfaces are small it wraps them, otherwise it resamples them. The same seed gives the
/// same result.
JunctionMesh MeshJunction(const Junction& junction, const JunctionMeshOptions& options,
                          uint64_t seed);

}  // namespace curvefusion
