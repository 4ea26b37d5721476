#pragma once

#include <cstdint>

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// What the union of a skeleton's tubes is, found without meshing: a tube is the union of all balls
/// of the local radius about the points of its edges. Every edge must have radii.

/// Euler characteristic and components of the union of tubes `scale` times as thick, from a
/// weighted alpha complex of balls every tenth of a radius.
struct Topology {
  int64_t euler = 0;
  int64_t components = 0;
  bool operator==(const Topology&) const = default;
};
Topology TopologyOfTubes(const SkeletonGraph& graph, double scale = 1);

/// The same, exactly, for straight edges of one radius of which no three meet at one place: their
/// tubes are convex, so each contact joins two of them and nothing else (nerve theorem). Balls
/// along wires side by side wave, which makes holes that are not there.
Topology TopologyOfStraightTubes(const SkeletonGraph& graph, double scale = 1);

/// The number of contacts that come or go, and of holes and pockets that open or close, while all
/// radii grow from 1 - scale_tolerance to 1 + scale_tolerance: that many may come out either way.
/// Two that cancel each other within a fifth of the tolerance are not counted.
int64_t CountGrazingContacts(const SkeletonGraph& graph, double scale_tolerance);

/// Contacts that the steps of CountGrazingContacts pass over: where tubes run nearly along each
/// other, the number of places at which the distance of their axes turns within the tolerance
/// (a part of the sum of the radii) of touching. At each a contact may come or go.
int64_t CountGrazingTurns(const SkeletonGraph& graph, double tolerance);

/// The greatest distance of a vertex of the mesh from the surface of its nearest tube, outwards and
/// inwards, in radii of that tube.
struct SurfaceDeviation {
  double outwards = 0;
  double inwards = 0;
};
SurfaceDeviation DeviationFromTubes(const TriangleMesh& mesh, const SkeletonGraph& graph);

}  // namespace curvefusion
