#pragma once

#include <array>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// An indexed triangle mesh without connectivity, counter-clockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3f> vertices;                ///< metres
  std::vector<std::array<int, 3>> triangles;  ///< indices into vertices
};

}  // namespace curvefusion
