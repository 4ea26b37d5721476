#pragma once

#include "fusion/solid_parts/surface_triangles.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Assigns each part of a surface (without that of the room) to the tubes or, marked, to the
/// object's solids. What lies within `reach` metres of a tube is the tube's at first, as is all
/// that is smaller than a disc of that radius: volumes hold wires, fattened. Of the rest a piece is
/// the object's where it comes within `reach` and `blur` of a tube and does not leave the box. It
/// then grows back by `reach` along the surface, but not onto what a tube explains: within `blur`
/// of one and turned away from its axis. Axes without radii count as lines.
TriangleMarks FindAttachedSurface(const SurfaceTriangles& surface, const TriangleMarks& room,
                                  const SkeletonGraph& skeleton, double reach, double blur);

}  // namespace curvefusion
