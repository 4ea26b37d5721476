#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Skeletons for the tests and benchmarks of meshing. Lengths in metres.

/// Gives an edge radii that run evenly from `first` to `last`.
void SetRadius(SkeletonGraph& graph, EdgeId id, double first, double last);

/// Adds an edge of one radius; the ends of `points` are the nodes' positions.
EdgeId AddTube(SkeletonGraph& graph, NodeId a, NodeId b, Polyline points, double radius);
EdgeId AddStraight(SkeletonGraph& graph, NodeId a, NodeId b, double radius);

/// Adds a curve of one radius with nodes of its own.
EdgeId AddCurve(SkeletonGraph& graph, const Polyline& points, double radius);

/// n + 1 points of an arc in the plane of the unit vectors u and v.
Polyline Arc(const Vec3& centre, const Vec3& u, const Vec3& v, double radius, double from,
             double to, int n);

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

}  // namespace curvefusion
