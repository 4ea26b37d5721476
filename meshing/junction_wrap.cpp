#include "meshing/junction_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cstddef>
#include <vector>

#include "meshing/junction_core.h"

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Wrap = CGAL::Surface_mesh<Point>;

// In radii.
constexpr double kAlpha = 1.0 / 3;
constexpr double kOffset = 0.02;

TriangleMesh WrapAround(const std::vector<TriangleMesh>& stubs, double radius) {
  std::vector<Point> points;
  std::vector<std::array<std::size_t, 3>> faces;
  for (const TriangleMesh& stub : stubs) {
    const std::size_t first = points.size();
    for (const Vec3f& v : stub.vertices) points.emplace_back(v.x(), v.y(), v.z());
    for (const auto& [a, b, c] : stub.triangles) {
      faces.push_back({first + static_cast<std::size_t>(a), first + static_cast<std::size_t>(b),
                       first + static_cast<std::size_t>(c)});
    }
  }
  Wrap wrap;
  CGAL::alpha_wrap_3(points, faces, kAlpha * radius, kOffset * radius, wrap);
  TriangleMesh mesh;
  std::vector<int> index(wrap.number_of_vertices() + wrap.number_of_removed_vertices());
  for (const Wrap::Vertex_index v : wrap.vertices()) {
    index[v] = static_cast<int>(mesh.vertices.size());
    const Point& p = wrap.point(v);
    mesh.vertices.push_back(Vec3(p.x(), p.y(), p.z()).cast<float>());
  }
  for (const Wrap::Face_index face : wrap.faces()) {
    std::array<int, 3> triangle{};
    int corner = 0;
    for (const Wrap::Vertex_index v : wrap.vertices_around_face(wrap.halfedge(face))) {
      triangle[corner++] = index[v];
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace

std::optional<UnionMesh> WrapJunction(const Junction& junction) {
  return ReplaceCore(junction, [&](const std::vector<TriangleMesh>& stubs, double) {
    return WrapAround(stubs, junction.radius);
  });
}

}  // namespace curvefusion
