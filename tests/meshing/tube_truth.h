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

/// The Euler characteristics that the union may have where every contact, hole or pocket that comes
/// or goes while all radii grow from 1 - tolerance to 1 + tolerance may be there or not, whatever
/// the others are. Each changes the characteristic by one, and by another where a hole leaves a
/// pocket; they are found exactly, as critical simplices of the weighted alpha complex. Those
/// within half a radius that follow each other at once count as what they do together: balls along
/// two tubes touch in several pairs where the tubes touch once. Where radii differ the tolerance is
/// a part of the least, and what the characteristic is at eleven scales within it counts as well.
struct EulerRange {
  int64_t low = 0;
  int64_t high = 0;
  bool Contains(int64_t euler) const { return low <= euler && euler <= high; }
};
EulerRange EulerOfTubesWithin(const SkeletonGraph& graph, double tolerance);

/// The greatest distance of a vertex of the mesh from the surface of its nearest tube, outwards and
/// inwards, in radii of that tube.
struct SurfaceDeviation {
  double outwards = 0;
  double inwards = 0;
};
SurfaceDeviation DeviationFromTubes(const TriangleMesh& mesh, const SkeletonGraph& graph);

}  // namespace curvefusion
