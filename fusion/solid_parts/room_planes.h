#pragma once

#include "fusion/solid_parts/surface_triangles.h"

namespace curvefusion {

/// The points with normal . p = offset; the free side is that to which the normal points.
struct RoomPlane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0;
};

/// What an object stands on or before.
struct RoomPlanes {
  std::vector<RoomPlane> planes;  ///< 100 at most
  TriangleMarks marks;            ///< 1 + index of its plane; 0 for what is not of the room
};

/// The triangles of what an object stands on or before: planes (RANSAC, Fischler and Bolles 1981)
/// that go on beyond the box, as floors, table tops and walls do. A seat or a lid ends within it. A
/// triangle belongs to a plane where it lies within `tolerance` metres and is turned by less than
/// 30 degrees. The same surface gives the same planes.
RoomPlanes FindRoomPlanes(const SurfaceTriangles& surface, double tolerance);

/// The marked triangles, flat in their planes.
TriangleMesh FlatRoom(const TriangleMesh& mesh, const RoomPlanes& room);

}  // namespace curvefusion
