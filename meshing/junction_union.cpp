#include "meshing/junction_union.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <exception>
#include <numeric>
#include <tuple>
#include <utility>

#include "meshing/direct_union.h"

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Kernel::Point_3>;

ExactMesh ToExact(const TriangleMesh& solid) {
  ExactMesh mesh;
  mesh.reserve(static_cast<unsigned>(solid.vertices.size()),
               static_cast<unsigned>(3 * solid.triangles.size() / 2),
               static_cast<unsigned>(solid.triangles.size()));
  for (const Vec3f& v : solid.vertices) mesh.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
  using Vertex = ExactMesh::Vertex_index;
  for (const auto& [a, b, c] : solid.triangles) {
    mesh.add_face(Vertex(static_cast<unsigned>(a)), Vertex(static_cast<unsigned>(b)),
                  Vertex(static_cast<unsigned>(c)));
  }
  return mesh;
}

UnionMesh ToDouble(const ExactMesh& mesh) {
  UnionMesh rounded;
  std::vector<int> index(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const ExactMesh::Vertex_index v : mesh.vertices()) {
    index[v] = static_cast<int>(rounded.vertices.size());
    const Kernel::Point_3& p = mesh.point(v);
    rounded.vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                                  CGAL::to_double(p.z()));
  }
  for (const ExactMesh::Face_index face : mesh.faces()) {
    std::array<int, 3> triangle{};
    int corner = 0;
    for (const ExactMesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(face))) {
      triangle[corner++] = index[v];
    }
    rounded.triangles.push_back(triangle);
  }
  return rounded;
}

// The same mesh numbered by coordinates: CGAL numbers in the order of addresses in memory, which
// differs from run to run.
UnionMesh InCanonicalOrder(const UnionMesh& mesh) {
  const auto place = [&mesh](int v) {
    const Vec3& p = mesh.vertices[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return place(a) < place(b); });
  UnionMesh sorted;
  std::vector<int> index(mesh.vertices.size());
  for (const int v : order) {
    index[v] = static_cast<int>(sorted.vertices.size());
    sorted.vertices.push_back(mesh.vertices[v]);
  }
  for (std::array<int, 3> triangle : mesh.triangles) {
    for (int& v : triangle) v = index[v];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    sorted.triangles.push_back(triangle);
  }
  std::sort(sorted.triangles.begin(), sorted.triangles.end());
  return sorted;
}

// Unites b with a, in a.
bool Unite(ExactMesh& a, ExactMesh& b) {
  try {
    return CGAL::Polygon_mesh_processing::corefine_and_compute_union(a, b, a);
  } catch (const std::exception&) {
    return false;  // CGAL's way to say that a solid intersects itself
  }
}

// Solids in the order of their centres along the longest side of their common box, so that the
// tournament unites neighbours first.
std::vector<size_t> OrderAlongLongestSide(const std::vector<TriangleMesh>& solids) {
  std::vector<Vec3f> centres;
  Eigen::AlignedBox3f box;
  for (const TriangleMesh& solid : solids) {
    Eigen::AlignedBox3f own;
    for (const Vec3f& v : solid.vertices) own.extend(v);
    centres.push_back(own.center());
    box.extend(own.center());
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  std::vector<size_t> order(solids.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return centres[a][axis] < centres[b][axis]; });
  return order;
}

// The solids in the order of a tournament of neighbours; nothing where a union does not come out.
template <class Solid, class Unite>
std::optional<Solid> Tournament(std::vector<Solid> round, const Unite& unite) {
  while (round.size() > 1) {
    std::vector<Solid> next_round;
    for (size_t i = 0; i + 1 < round.size(); i += 2) {
      if (!unite(round[i], round[i + 1])) return std::nullopt;
      next_round.push_back(std::move(round[i]));
    }
    if (round.size() % 2 == 1) next_round.push_back(std::move(round.back()));
    round = std::move(next_round);
  }
  return std::move(round.front());
}

std::optional<UnionMesh> UniteAllDirectly(const std::vector<TriangleMesh>& solids,
                                          const std::vector<size_t>& order) {
  std::vector<UnionMesh> round;
  for (const size_t i : order) {
    round.push_back({{}, solids[i].triangles});
    for (const Vec3f& v : solids[i].vertices) round.back().vertices.push_back(v.cast<double>());
  }
  return Tournament(std::move(round), [](UnionMesh& a, const UnionMesh& b) {
    std::optional<UnionMesh> united = UniteDirectly(a, b);
    if (united) a = std::move(*united);
    return united.has_value();
  });
}

std::optional<UnionMesh> UniteAllExactly(const std::vector<TriangleMesh>& solids,
                                         const std::vector<size_t>& order) {
  std::vector<ExactMesh> round;
  for (const size_t i : order) round.push_back(ToExact(solids[i]));
  const auto united = Tournament(std::move(round), Unite);
  if (!united) return std::nullopt;
  return InCanonicalOrder(ToDouble(*united));
}

}  // namespace

std::optional<UnionMesh> UniteSolidsDirectly(const std::vector<TriangleMesh>& solids) {
  if (solids.empty()) return UnionMesh{};
  return UniteAllDirectly(solids, OrderAlongLongestSide(solids));
}

std::optional<UnionMesh> UniteSolids(const std::vector<TriangleMesh>& solids) {
  if (solids.empty()) return UnionMesh{};
  const std::vector<size_t> order = OrderAlongLongestSide(solids);
  std::optional<UnionMesh> united = UniteAllDirectly(solids, order);
  return united ? united : UniteAllExactly(solids, order);
}

}  // namespace curvefusion
