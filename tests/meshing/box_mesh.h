#pragma once

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// A box with outward normals. Bit k of a vertex's index tells on which side it lies along axis k.
inline TriangleMesh BoxMesh(const Vec3f& min, const Vec3f& max) {
  TriangleMesh box;
  for (int corner = 0; corner < 8; ++corner) {
    box.vertices.emplace_back(corner & 1 ? max.x() : min.x(), corner & 2 ? max.y() : min.y(),
                              corner & 4 ? max.z() : min.z());
  }
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return box;
}

}  // namespace curvefusion
