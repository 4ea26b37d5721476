#pragma once

#include "fusion/solid_parts/room_planes.h"

namespace curvefusion {

/// Where marked pieces of a surface stand on or lean against planes of the room, which no camera
/// sees: the convex hull, in the plane, of what comes within `reach` metres of it. Pieces that
/// reach through the plane do not stand on it. The triangles face to the plane's free side.
TriangleMesh ContactFaces(const SurfaceTriangles& surface, const TriangleMarks& marked,
                          const std::vector<RoomPlane>& planes, double reach);

}  // namespace curvefusion
