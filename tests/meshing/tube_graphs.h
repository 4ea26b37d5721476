#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Skeletons for the tests and benchmarks of meshing. Lengths in metres.

/// Joins curves into a graph: a node wherever an end of a curve lies within `tolerance` of another
/// curve, or two curves pass each other that closely. A closed curve repeats its first point.
struct WireCurve {
  Polyline points;
  double radius;
};
SkeletonGraph JoinCurves(const std::vector<WireCurve>& curves, double tolerance);

/// A bird cage of 5 rings and 10 wires: 48 junctions, 6 m of wire of radius 2.25 mm.
SkeletonGraph CageGraph();

/// A wire chair: 16 by 21 wires of radius 2.25 mm on a curved sheet (336 junctions) and 4 legs.
SkeletonGraph ChairGraph();

/// n x n x n nodes of a cubic lattice with this spacing and radius.
SkeletonGraph LatticeGraph(int n, double spacing, double radius);

/// Straight arms of this length from the origin in these directions (any length > 0).
SkeletonGraph StarGraph(const std::vector<Vec3>& directions, double length, double radius);

/// A helix about the z axis.
SkeletonGraph HelixGraph(double helix_radius, double pitch, int turns, double radius);

/// A circle in the xy plane.
SkeletonGraph RingGraph(double ring_radius, double radius);

/// The kinds of hard networks that RandomHardGraph makes.
const std::vector<std::string>& HardKinds();

/// A random network of a kind that is hard to mesh; the same seed gives the same network.
SkeletonGraph RandomHardGraph(const std::string& kind, uint64_t seed);

}  // namespace curvefusion
