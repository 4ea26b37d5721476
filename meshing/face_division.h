#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// A triangle to be divided along segments. Vertices are indices into a common list.
struct FaceToDivide {
  std::vector<int> boundary;  ///< counter-clockwise from a corner, with what lies on the edges
  std::array<int, 3> corners{};
  std::vector<std::pair<int, int>> segments;  ///< within the triangle; they meet at vertices only
};

/// The triangles of a constrained Delaunay triangulation of a face, oriented as it is. What is on
/// an edge may be off it by rounding. Nothing where rounding made points coincide or segments
/// cross. O(n log n).
std::optional<std::vector<std::array<int, 3>>> DivideFace(const FaceToDivide& face,
                                                          const std::vector<Vec3>& vertices);

}  // namespace curvefusion
