#include "meshing/face_division.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <map>

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;

// Coordinates in the plane of a triangle.
class Plane {
 public:
  Plane(const Vec3& a, const Vec3& b, const Vec3& c)
      : origin_(a), u_((b - a).normalized()), v_((b - a).cross(c - a).cross(u_).normalized()) {}

  Kernel::Point_2 Place(const Vec3& p) const {
    return {(p - origin_).dot(u_), (p - origin_).dot(v_)};
  }

 private:
  Vec3 origin_, u_, v_;
};

class Division {
 public:
  Division(const FaceToDivide& face, const std::vector<Vec3>& vertices)
      : vertices_(vertices),
        plane_(vertices[face.corners[0]], vertices[face.corners[1]], vertices[face.corners[2]]) {}

  bool Constrain(int from, int to) {
    const auto a = Insert(from);
    const auto b = Insert(to);
    if (a == nullptr || b == nullptr) return false;
    try {
      triangulation_.insert_constraint(a, b);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      return false;
    }
    return true;
  }

  // The triangles that cannot be reached from outside without crossing a constraint.
  std::vector<std::array<int, 3>> InnerTriangles() const {
    std::map<Triangulation::Face_handle, bool> outside = {{triangulation_.infinite_face(), true}};
    std::vector<Triangulation::Face_handle> open = {triangulation_.infinite_face()};
    while (!open.empty()) {
      const Triangulation::Face_handle face = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) {
        if (triangulation_.is_constrained({face, k})) continue;
        if (outside.try_emplace(face->neighbor(k), true).second) open.push_back(face->neighbor(k));
      }
    }
    std::vector<std::array<int, 3>> inner;
    for (const auto face : triangulation_.finite_face_handles()) {
      if (outside.count(face) > 0) continue;
      inner.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
    return inner;
  }

 private:
  // Null where another vertex is at the same place.
  Triangulation::Vertex_handle Insert(int vertex) {
    const auto [entry, is_new] = handles_.try_emplace(vertex);
    if (is_new) {
      const size_t count = triangulation_.number_of_vertices();
      entry->second = triangulation_.insert(plane_.Place(vertices_[vertex]));
      if (triangulation_.number_of_vertices() == count) return nullptr;
      entry->second->info() = vertex;
    }
    return entry->second;
  }

  const std::vector<Vec3>& vertices_;
  Plane plane_;
  Triangulation triangulation_;
  std::map<int, Triangulation::Vertex_handle> handles_;
};

}  // namespace

std::optional<std::vector<std::array<int, 3>>> DivideFace(const FaceToDivide& face,
                                                          const std::vector<Vec3>& vertices) {
  Division division(face, vertices);
  for (size_t i = 0; i < face.boundary.size(); ++i) {
    const int next = face.boundary[(i + 1) % face.boundary.size()];
    if (!division.Constrain(face.boundary[i], next)) return std::nullopt;
  }
  for (const auto& [from, to] : face.segments) {
    if (!division.Constrain(from, to)) return std::nullopt;
  }
  return division.InnerTriangles();
}

}  // namespace curvefusion
