#pragma once

#include <cstdint>
#include <optional>

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// What the union of a skeleton's tubes is, found without meshing: a tube is the union of all balls
/// of the local radius about the points of its edges. Every edge must have radii.

/// Euler characteristic and components of the union, from a weighted alpha complex of balls every
/// tenth of a radius. Nothing where the answer depends on 3 % of the radius: then tubes nearly
/// touch or a hole is about to close.
struct Topology {
  int64_t euler = 0;
  int64_t components = 0;
  bool operator==(const Topology&) const = default;
};
std::optional<Topology> TopologyOfTubes(const SkeletonGraph& graph);

/// The greatest distance of a vertex of the mesh from the surface of its nearest tube, outwards and
/// inwards, in radii of that tube.
struct SurfaceDeviation {
  double outwards = 0;
  double inwards = 0;
};
SurfaceDeviation DeviationFromTubes(const TriangleMesh& mesh, const SkeletonGraph& graph);

}  // namespace curvefusion
