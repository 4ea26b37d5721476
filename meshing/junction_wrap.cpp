#include "meshing/junction_wrap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Wrap = CGAL::Surface_mesh<Point>;

// In radii.
constexpr double kAlpha = 1.0 / 3;
constexpr double kOffset = 0.02;
// The wrap begins so far inside a cut ring, in parts of the segment there; the unchanged end of the
// stub reaches twice as far and gets thinner on the way, so that the two meet at an angle.
constexpr double kWrapStart = 0.3;
constexpr double kCollarEnd = 0.6;
constexpr double kCollarTaper = 0.85;

// Where a tube is cut: the ring and the way to the next one inwards.
struct Cut {
  std::vector<Vec3f> ring;
  Vec3 centre = Vec3::Zero();
  Vec3 inwards = Vec3::Zero();
};

std::tuple<float, float, float> PlaceOf(const Vec3f& p) { return {p.x(), p.y(), p.z()}; }

Vec3 MeanOf(const std::vector<Vec3f>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3f& p : points) sum += p.cast<double>();
  return sum / static_cast<double>(points.size());
}

// The cut at a ring of one stub, whose ring vertices are marked.
Cut CutAt(const TriangleMesh& stub, const std::vector<char>& in_ring,
          const std::vector<Vec3f>& ring) {
  std::vector<Vec3f> neighbours;
  for (const auto& triangle : stub.triangles) {
    const bool touches = in_ring[triangle[0]] || in_ring[triangle[1]] || in_ring[triangle[2]];
    for (const int v : triangle) {
      if (touches && !in_ring[v]) neighbours.push_back(stub.vertices[v]);
    }
  }
  const Vec3 centre = MeanOf(ring);
  return {ring, centre, neighbours.empty() ? Vec3::Zero() : Vec3(MeanOf(neighbours) - centre)};
}

// Moves the cut rings of a stub inwards; the cuts are appended to `cuts`.
TriangleMesh Shortened(const TriangleMesh& stub, const Junction& junction, std::vector<Cut>& cuts) {
  TriangleMesh shortened = stub;
  for (const std::vector<Vec3f>& ring : junction.cut_rings) {
    std::set<std::tuple<float, float, float>> places;
    for (const Vec3f& p : ring) places.insert(PlaceOf(p));
    std::vector<char> in_ring(stub.vertices.size(), 0);
    for (size_t v = 0; v < stub.vertices.size(); ++v) {
      in_ring[v] = places.count(PlaceOf(stub.vertices[v])) > 0;
    }
    if (static_cast<size_t>(std::count(in_ring.begin(), in_ring.end(), 1)) != ring.size()) continue;
    cuts.push_back(CutAt(stub, in_ring, ring));
    const Vec3f shift = (kWrapStart * cuts.back().inwards).cast<float>();
    for (size_t v = 0; v < stub.vertices.size(); ++v) {
      if (in_ring[v]) shortened.vertices[v] += shift;
    }
  }
  return shortened;
}

// The end of a stub: a closed frustum on the ring, outward normals.
TriangleMesh Collar(const Cut& cut) {
  const int n = static_cast<int>(cut.ring.size());
  TriangleMesh collar{cut.ring, {}};
  for (const Vec3f& p : cut.ring) {
    const Vec3 inner =
        cut.centre + kCollarEnd * cut.inwards + kCollarTaper * (p.cast<double>() - cut.centre);
    collar.vertices.push_back(inner.cast<float>());
  }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    collar.triangles.push_back({k, next, n + next});
    collar.triangles.push_back({k, n + next, n + k});
    if (k < 2) continue;
    collar.triangles.push_back({0, k, k - 1});
    collar.triangles.push_back({n, n + k - 1, n + k});
  }
  const Vec3 a = cut.ring[0].cast<double>() - cut.centre;
  const Vec3 b = cut.ring[1].cast<double>() - cut.centre;
  if (a.cross(b).dot(cut.inwards) < 0) {
    for (auto& triangle : collar.triangles) std::swap(triangle[0], triangle[1]);
  }
  return collar;
}

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
  std::vector<Cut> cuts;
  std::vector<TriangleMesh> shortened;
  for (const TriangleMesh& stub : junction.stubs) {
    shortened.push_back(Shortened(stub, junction, cuts));
  }
  if (cuts.size() != junction.cut_rings.size()) return std::nullopt;
  std::vector<TriangleMesh> solids = {WrapAround(shortened, junction.radius)};
  for (const Cut& cut : cuts) solids.push_back(Collar(cut));
  return UniteSolids(solids);
}

}  // namespace curvefusion
