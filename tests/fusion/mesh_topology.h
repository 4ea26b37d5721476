#pragma once

#include <algorithm>
#include <map>
#include <utility>

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// How often each directed edge occurs.
inline std::map<std::pair<int, int>, int> DirectedEdges(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  }
  return edges;
}

/// Whether each edge occurs once in either direction.
inline bool IsClosedOrientedManifold(const TriangleMesh& mesh) {
  const auto edges = DirectedEdges(mesh);
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return edge.second == 1 && edges.count({edge.first.second, edge.first.first}) == 1;
  });
}

/// V - E + F of a closed mesh.
inline int EulerCharacteristic(const TriangleMesh& mesh) {
  const int edges = static_cast<int>(DirectedEdges(mesh).size()) / 2;
  return static_cast<int>(mesh.vertices.size()) - edges + static_cast<int>(mesh.triangles.size());
}

/// Volume of a closed mesh, positive when oriented outwards.
inline double SignedVolume(const TriangleMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].cast<double>().dot(
                  mesh.vertices[b].cast<double>().cross(mesh.vertices[c].cast<double>())) /
              6;
  }
  return volume;
}

}  // namespace curvefusion
