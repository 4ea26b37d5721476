#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/voxel_grid.h"
#include "tests/graph/tube_points.h"

namespace curvefusion {

/// Points of round wires as they are carried to the extraction: 20 points per mm of curve with 1 mm
/// of noise, on a grid of 2.5 mm with counts.
inline ObservedPoints NoisyWires(const std::vector<Polyline>& axes, double radius = 2.5e-3,
                                 double noise = 1e-3) {
  ObservedPoints points;
  for (const Polyline& axis : axes) {
    AddTube(axis, radius, static_cast<int>(20000 * Length(axis)), noise, points);
  }
  return ResampleOnGrid(points, 2.5e-3);
}

/// Distance of a point to the nearest of several curves. Brute force.
inline double DistanceTo(const std::vector<Polyline>& curves, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Polyline& curve : curves) nearest = std::min(nearest, Project(curve, p).distance);
  return nearest;
}

/// Greatest distance from the vertices of a graph to the nearest of several curves.
inline double GreatestDistance(const SkeletonGraph& graph, const std::vector<Polyline>& curves) {
  double greatest = 0;
  for (const EdgeId id : graph.Edges()) {
    for (const Vec3& p : graph.edge(id).points) {
      greatest = std::max(greatest, DistanceTo(curves, p));
    }
  }
  return greatest;
}

/// Greatest distance from the points of curves, every mm, to the nearest edge of a graph.
inline double GreatestGap(const SkeletonGraph& graph, const std::vector<Polyline>& curves) {
  std::vector<Polyline> edges;
  for (const EdgeId id : graph.Edges()) edges.push_back(graph.edge(id).points);
  double greatest = 0;
  for (const Polyline& curve : curves) {
    for (const Vec3& p : Resample(curve, 1e-3)) greatest = std::max(greatest, DistanceTo(edges, p));
  }
  return greatest;
}

inline bool SameBits(const SkeletonGraph& a, const SkeletonGraph& b) {
  if (a.Nodes() != b.Nodes() || a.Edges() != b.Edges()) return false;
  const std::vector<EdgeId> edges = a.Edges();
  return std::all_of(edges.begin(), edges.end(), [&](EdgeId edge) {
    return a.edge(edge).points == b.edge(edge).points && a.edge(edge).nodes == b.edge(edge).nodes;
  });
}

}  // namespace curvefusion
