#pragma once

#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// Wires that end less than `reach` metres before a solid are led on to it, straight: near
/// surfaces a wire has no depth of its own. The new ends have the wires' radii.
SkeletonGraph LedToSolids(SkeletonGraph skeleton, const std::vector<TriangleMesh>& solids,
                          double reach);

}  // namespace curvefusion
