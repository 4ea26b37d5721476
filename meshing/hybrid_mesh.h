#pragma once

#include <vector>

#include "kernel/triangle_mesh.h"
#include "meshing/watertight.h"

namespace curvefusion {

/// Tubes and the solids that they are attached to, as one surface.
struct HybridMesh {
  TriangleMesh mesh;
  WatertightReport report;  ///< of the mesh; always watertight
  int attempts = 0;         ///< at an exact union
  bool resampled = false;   ///< none came out: on a grid of half the radius, as far as it is fine
};

/// The union of tubes (BuildTubes) and closed solids. What is inside is decided exactly, so that
/// tubes keep their shape to where they enter a solid; after a few attempts, each with vertices
/// moved by some thousandths of `radius` (metres, of the thinnest tube), the union is resampled.
/// Without solids the tubes, without tubes the solids. Throws Error(kBadInput) where that is not
/// watertight either.
HybridMesh UniteTubesAndSolids(const TriangleMesh& tubes, const std::vector<TriangleMesh>& solids,
                               double radius);

}  // namespace curvefusion
