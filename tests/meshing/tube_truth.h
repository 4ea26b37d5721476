#pragma once

#include <cstdint>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// What the union of a skeleton's tubes is, found without meshing: a tube is the union of all balls
/// of the local radius about the points of its edges. Every edge must have radii.

struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// Balls of the tubes, every tenth of a radius. They lie off the axes at random by a
/// hundred-thousandth of it: triangulations need points that are not all in one plane.
std::vector<Ball> BallsAlong(const SkeletonGraph& graph);

struct Topology {
  int64_t euler = 0;  ///< Euler characteristic
  int64_t components = 0;
  bool operator==(const Topology&) const = default;
};

/// What a union of balls is, from their weighted alpha complex.
Topology TopologyOfBalls(const std::vector<Ball>& balls);

/// The same of the balls along all tubes. Balls along wires side by side wave, which may make holes
/// between them that are not there.
Topology TopologyOfTubes(const SkeletonGraph& graph);

/// The greatest distance of a vertex of the mesh from the surface of its nearest tube, outwards and
/// inwards, in radii of that tube.
struct SurfaceDeviation {
  double outwards = 0;
  double inwards = 0;
};
SurfaceDeviation DeviationFromTubes(const TriangleMesh& mesh, const SkeletonGraph& graph);

}  // namespace curvefusion
