#pragma once

#include <string>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"
#include "meshing/tubes.h"
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

/// The tubes of a skeleton and solids likewise; the tubes of curves without radii have
/// `default_radius`, as BuildTubes gives it to them.
HybridMesh UniteWithSolids(const SkeletonGraph& skeleton, const TubeMesh& tubes,
                           const std::vector<TriangleMesh>& solids, double default_radius);

/// What the user should know of a hybrid mesh, a sentence each.
std::vector<std::string> HybridWarnings(const HybridMesh& hybrid);

}  // namespace curvefusion
