#include "meshing/corner_normals.h"

#include <algorithm>
#include <cmath>

#include "kernel/disjoint_sets.h"
#include "meshing/half_edges.h"

namespace curvefusion {

namespace {

// Normals as long as twice the areas.
std::vector<Vec3> AreaNormals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 origin = mesh.vertices[a].cast<double>();
    normals.push_back(
        (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin));
  }
  return normals;
}

// The angle of a triangle at a corner; less where the triangle is so thin that rounding may turn
// its normal.
double Weight(const TriangleMesh& mesh, int face, int k) {
  constexpr double kThin = 0.01;  // height over longest edge
  const auto at = [&](int i) {
    return Vec3(mesh.vertices[mesh.triangles[face][(k + i) % 3]].cast<double>());
  };
  const Vec3 u = at(1) - at(0);
  const Vec3 v = at(2) - at(0);
  const double twice_area = u.cross(v).norm();
  const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
  if (longest <= 0) return 0;
  const double slimness = twice_area / (longest * longest);
  return std::atan2(twice_area, u.dot(v)) * std::min(1.0, slimness / kThin);
}

// Joins the corners on both sides of every edge that is no crease.
void JoinSmoothCorners(const TriangleMesh& mesh, const std::vector<Vec3>& face_normals,
                       double crease_angle, DisjointSets& corners) {
  const double min_cos = std::cos(crease_angle);
  const std::vector<HalfEdge> half_edges = SortedHalfEdges(mesh.triangles);
  for (size_t i = 0; i + 1 < half_edges.size(); ++i) {
    const HalfEdge& a = half_edges[i];
    const HalfEdge& b = half_edges[i + 1];
    if (a.low != b.low || a.high != b.high || a.forward == b.forward) continue;
    const Vec3& m = face_normals[a.face];
    const Vec3& n = face_normals[b.face];
    if (m.dot(n) < min_cos * m.norm() * n.norm()) continue;
    for (const int vertex : {a.low, a.high}) {
      corners.Unite(CornerOf(mesh, a.face, vertex), CornerOf(mesh, b.face, vertex));
    }
  }
}

}  // namespace

CornerNormals ComputeCornerNormals(const TriangleMesh& mesh, double crease_angle) {
  const std::vector<Vec3> face_normals = AreaNormals(mesh);
  const int corner_count = 3 * static_cast<int>(mesh.triangles.size());
  DisjointSets corners(static_cast<size_t>(corner_count));
  JoinSmoothCorners(mesh, face_normals, crease_angle, corners);
  std::vector<Vec3> sums;
  std::vector<int> of_root(corner_count, -1);
  CornerNormals result;
  result.of_corner.resize(mesh.triangles.size());
  for (int corner = 0; corner < corner_count; ++corner) {
    int& index = of_root[corners.Root(corner)];
    if (index < 0) {
      index = static_cast<int>(sums.size());
      sums.push_back(Vec3::Zero());
    }
    sums[index] += Weight(mesh, corner / 3, corner % 3) * face_normals[corner / 3].normalized();
    result.of_corner[corner / 3][corner % 3] = index;
  }
  for (const Vec3& sum : sums) {
    const Vec3 unit = sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
    result.normals.push_back(unit.cast<float>());
  }
  return result;
}

}  // namespace curvefusion
