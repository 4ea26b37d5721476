#include "meshing/half_edges.h"

#include <algorithm>
#include <tuple>

namespace curvefusion {

std::vector<HalfEdge> SortedHalfEdges(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(3 * triangles.size());
  for (size_t f = 0; f < triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[f][k];
      const int b = triangles[f][(k + 1) % 3];
      half_edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<int>(f)});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& x, const HalfEdge& y) {
    return std::tie(x.low, x.high, x.face, x.forward) < std::tie(y.low, y.high, y.face, y.forward);
  });
  return half_edges;
}

int CornerOf(const TriangleMesh& mesh, int face, int vertex) {
  const auto& t = mesh.triangles[face];
  return 3 * face + static_cast<int>(std::find(t.begin(), t.end(), vertex) - t.begin());
}

}  // namespace curvefusion
