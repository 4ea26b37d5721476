#include "fusion/solid_parts/surface_triangles.h"

#include <algorithm>
#include <array>
#include <map>

#include "kernel/disjoint_sets.h"

namespace curvefusion {

SurfaceTriangles TrianglesWithin(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box) {
  SurfaceTriangles surface;
  TriangleMarks within(mesh.triangles.size(), 0);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::array<Vec3, 3> corner = CornersOf(mesh, i);
    const auto inside =
        std::count_if(corner.begin(), corner.end(), [&](const Vec3& p) { return box.contains(p); });
    const Vec3 cross = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const double area = cross.norm() / 2;
    if (inside == 0 || area <= 0) continue;
    within[i] = 1;
    surface.centers.push_back((corner[0] + corner[1] + corner[2]) / 3);
    surface.normals.push_back(cross.normalized());
    surface.areas.push_back(area);
    surface.is_cut.push_back(inside < 3);
  }
  surface.mesh = MarkedPart(mesh, within);
  return surface;
}

std::vector<SurfacePiece> PiecesOf(const SurfaceTriangles& surface, const TriangleMarks& marked) {
  DisjointSets sets(surface.mesh.vertices.size());
  for (size_t i = 0; i < surface.size(); ++i) {
    if (!marked[i]) continue;
    const auto& [a, b, c] = surface.mesh.triangles[i];
    sets.Unite(a, b);
    sets.Unite(b, c);
  }
  std::vector<SurfacePiece> pieces;
  std::map<int, size_t> piece_of_root;
  for (size_t i = 0; i < surface.size(); ++i) {
    if (!marked[i]) continue;
    const int root = sets.Root(surface.mesh.triangles[i][0]);
    const auto [found, is_new] = piece_of_root.emplace(root, pieces.size());
    if (is_new) pieces.emplace_back();
    SurfacePiece& piece = pieces[found->second];
    piece.triangles.push_back(static_cast<int>(i));
    piece.area += surface.areas[i];
    piece.is_cut = piece.is_cut || surface.is_cut[i];
  }
  return pieces;
}

TriangleMesh MarkedPart(const TriangleMesh& mesh, const TriangleMarks& marked) {
  TriangleMesh part;
  std::vector<int> index(mesh.vertices.size(), -1);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!marked[i]) continue;
    std::array<int, 3> triangle = mesh.triangles[i];
    for (int& v : triangle) {
      if (index[v] < 0) {
        index[v] = static_cast<int>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[v]);
      }
      v = index[v];
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

}  // namespace curvefusion
