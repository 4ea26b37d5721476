#pragma once

#include <optional>

#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// How rough a surface is: the mean angle, by area, between its normal and that of the true tube
/// below it, in radians; of triangles whose centres lie within 5 mm of a true tube's surface. About
/// 0 for tubes along the true curves; independent of small errors of position and radius. None
/// where no triangle is that near. The normal of a tube points away from the nearest true curve.
std::optional<double> MeanNormalError(const TriangleMesh& mesh, const SkeletonGraph& truth);

}  // namespace curvefusion
