#pragma once

#include "fusion/solid_parts/surface_triangles.h"

namespace curvefusion {

/// The triangles of what an object stands on or before: planes (RANSAC, Fischler and Bolles 1981)
/// that go on beyond the box, as floors, table tops and walls do. A seat or a lid ends within it. A
/// triangle belongs to a plane where it lies within `tolerance` metres and is turned by less than
/// 30 degrees. The same surface gives the same planes.
TriangleMarks FindRoomPlanes(const SurfaceTriangles& surface, double tolerance);

}  // namespace curvefusion
