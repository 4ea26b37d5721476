#pragma once

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// Wires that end less than `reach` metres before a closed surface are led on to it, straight: near
/// surfaces a wire has no depth of its own. The new ends have the wires' radii.
SkeletonGraph LedToSurface(SkeletonGraph skeleton, const TriangleMesh& surface, double reach);

}  // namespace curvefusion
