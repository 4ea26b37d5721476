#include "meshing/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <limits>

#include "kernel/box_pairs.h"
#include "kernel/geometry.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point At(const TriangleMesh& mesh, int vertex) {
  const Vec3f& v = mesh.vertices[vertex];
  return {v.x(), v.y(), v.z()};
}

Kernel::Triangle_3 TriangleAt(const TriangleMesh& mesh, int face) {
  const auto& [a, b, c] = mesh.triangles[face];
  return {At(mesh, a), At(mesh, b), At(mesh, c)};
}

// Puts the vertices that both triangles use first, in the same order; returns their number.
int AlignShared(std::array<int, 3>& s, std::array<int, 3>& t) {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    const auto found = std::find(t.begin() + shared, t.end(), s[i]);
    if (found == t.end()) continue;
    std::swap(t[shared], *found);
    std::swap(s[shared], s[i]);
    ++shared;
  }
  return shared;
}

// Two triangles on a common edge a-b overlap where they lie in one plane on the same side of it.
bool FoldedOver(const Point& a, const Point& b, const Point& c, const Point& d) {
  return CGAL::orientation(a, b, c, d) == CGAL::COPLANAR &&
         CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
}

// Whether the last two corners of `t` lie strictly on one side of the plane of `s`. Triangles that
// share their first corner then meet nowhere else; nearly all neighbours do so.
bool OnOneSide(const TriangleMesh& mesh, const std::array<int, 3>& s, const std::array<int, 3>& t) {
  const Point a = At(mesh, s[0]);
  const Point b = At(mesh, s[1]);
  const Point c = At(mesh, s[2]);
  const CGAL::Orientation side = CGAL::orientation(a, b, c, At(mesh, t[1]));
  return side != CGAL::COPLANAR && side == CGAL::orientation(a, b, c, At(mesh, t[2]));
}

bool Intersect(const TriangleMesh& mesh, int i, int j) {
  std::array<int, 3> s = mesh.triangles[i];
  std::array<int, 3> t = mesh.triangles[j];
  switch (AlignShared(s, t)) {
    case 0:
      return CGAL::do_intersect(TriangleAt(mesh, i), TriangleAt(mesh, j));
    case 1:
      if (OnOneSide(mesh, s, t) || OnOneSide(mesh, t, s)) return false;
      return CGAL::do_intersect(Kernel::Segment_3(At(mesh, s[1]), At(mesh, s[2])),
                                TriangleAt(mesh, j)) ||
             CGAL::do_intersect(Kernel::Segment_3(At(mesh, t[1]), At(mesh, t[2])),
                                TriangleAt(mesh, i));
    case 2:
      return FoldedOver(At(mesh, s[0]), At(mesh, s[1]), At(mesh, s[2]), At(mesh, t[2]));
    default:
      return true;
  }
}

bool IsDegenerate(const TriangleMesh& mesh, int face) {
  const auto& [a, b, c] = mesh.triangles[face];
  return CGAL::collinear(At(mesh, a), At(mesh, b), At(mesh, c));
}

// The pairs of triangles that may meet, wherever their vertices are moved by less than `margin`.
std::vector<std::pair<int, int>> CandidatePairs(const TriangleMesh& mesh, double margin) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    Eigen::AlignedBox3d box;
    for (const int v : triangle) box.extend(mesh.vertices[v].cast<double>());
    box.min().array() -= margin;
    box.max().array() += margin;
    boxes.push_back(box);
  }
  return OverlappingBoxes(boxes);
}

// Those of the candidates that meet, and the triangles without area.
std::vector<std::pair<int, int>> Meeting(const TriangleMesh& mesh,
                                         const std::vector<std::pair<int, int>>& candidates,
                                         int limit) {
  std::vector<std::pair<int, int>> found;
  std::vector<char> degenerate(mesh.triangles.size(), 0);
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
    degenerate[i] = IsDegenerate(mesh, i);
    if (degenerate[i]) found.emplace_back(i, i);
  }
  std::vector<char> hit(candidates.size(), 0);
  ParallelFor(0, static_cast<int64_t>(candidates.size()), 4096, [&](int64_t k) {
    const auto& [i, j] = candidates[k];
    if (!degenerate[i] && !degenerate[j]) hit[k] = Intersect(mesh, i, j);
  });
  for (size_t k = 0; k < candidates.size() && static_cast<int>(found.size()) < limit; ++k) {
    if (hit[k]) found.push_back(candidates[k]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<std::pair<int, int>> FindSelfIntersections(const TriangleMesh& mesh, int limit) {
  return Meeting(mesh, CandidatePairs(mesh, 0), limit);
}

std::vector<std::pair<int, int>> FindSelfIntersectionsInFiles(const TriangleMesh& mesh, int limit) {
  TriangleMesh millimetres = mesh;
  float farthest = 0;
  for (Vec3f& v : millimetres.vertices) {
    farthest = std::max(farthest, v.cwiseAbs().maxCoeff());
    v = (v.cast<double>() / kMillimetre).cast<float>();
  }
  // Rounding moves a coordinate by less.
  const double margin = farthest * std::numeric_limits<float>::epsilon();
  const std::vector<std::pair<int, int>> candidates = CandidatePairs(mesh, margin);
  std::vector<std::pair<int, int>> found = Meeting(mesh, candidates, limit);
  const std::vector<std::pair<int, int>> rounded = Meeting(millimetres, candidates, limit);
  found.insert(found.end(), rounded.begin(), rounded.end());
  return found;
}

}  // namespace curvefusion
