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

/// The corners of a triangle, in its order.
inline std::array<Vec3, 3> CornersOf(const TriangleMesh& mesh, size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.vertices[a].cast<double>(), mesh.vertices[b].cast<double>(),
          mesh.vertices[c].cast<double>()};
}

/// Adds the vertices and triangles of a mesh behind those of another.
inline void Append(const TriangleMesh& part, TriangleMesh& whole) {
  const int offset = static_cast<int>(whole.vertices.size());
  whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.triangles) {
    whole.triangles.push_back({a + offset, b + offset, c + offset});
  }
}

}  // namespace curvefusion
