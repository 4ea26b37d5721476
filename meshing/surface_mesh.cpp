#include "meshing/surface_mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

// OpenMesh prints when it is handed an edge twice in one direction: such meshes are told apart
// before.
bool HasRepeatedHalfEdge(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> half_edges;
  half_edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) half_edges.emplace_back(triangle[k], triangle[(k + 1) % 3]);
  }
  std::sort(half_edges.begin(), half_edges.end());
  return std::adjacent_find(half_edges.begin(), half_edges.end()) != half_edges.end();
}

}  // namespace

std::optional<SurfaceMesh> ToSurfaceMesh(const TriangleMesh& mesh) {
  if (HasRepeatedHalfEdge(mesh)) return std::nullopt;
  SurfaceMesh surface;
  surface.reserve(mesh.vertices.size(), 3 * mesh.triangles.size() / 2, mesh.triangles.size());
  for (const Vec3f& v : mesh.vertices) surface.add_vertex({v.x(), v.y(), v.z()});
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto face = surface.add_face(surface.vertex_handle(static_cast<unsigned>(a)),
                                       surface.vertex_handle(static_cast<unsigned>(b)),
                                       surface.vertex_handle(static_cast<unsigned>(c)));
    if (!face.is_valid()) return std::nullopt;
  }
  return surface;
}

TriangleMesh ToTriangleMesh(const SurfaceMesh& mesh) {
  TriangleMesh indexed;
  std::vector<int> index(mesh.n_vertices(), -1);
  for (const auto v : mesh.vertices()) {
    index[static_cast<size_t>(v.idx())] = static_cast<int>(indexed.vertices.size());
    const auto& p = mesh.point(v);
    indexed.vertices.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto face : mesh.faces()) {
    std::array<int, 3> triangle{};
    int corner = 0;
    for (const auto v : mesh.fv_range(face))
      triangle[corner++] = index[static_cast<size_t>(v.idx())];
    indexed.triangles.push_back(triangle);
  }
  return indexed;
}

}  // namespace curvefusion
