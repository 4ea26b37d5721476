#include "meshing/union_cleaning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "meshing/surface_mesh.h"

namespace curvefusion {

namespace {

constexpr int kMaxPasses = 12;
// A collapse or flip may turn the normal of a sound triangle by 60 or 25 degrees.
constexpr double kMinCosCollapse = 0.5;
constexpr double kMinCosFlip = 0.9;
// The shortest edge of a flat triangle may be collapsed up to this multiple of the least length.
constexpr double kFlatCollapse = 3;

using Vertex = SurfaceMesh::VertexHandle;
using HalfEdge = SurfaceMesh::HalfedgeHandle;
using Edge = SurfaceMesh::EdgeHandle;

Vec3 PointOf(const SurfaceMesh& mesh, Vertex v) {
  const auto& p = mesh.point(v);
  return {p[0], p[1], p[2]};
}

// The normal of a triangle, as long as twice its area.
Vec3 AreaNormal(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

double MinHeight(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return longest > 0 ? AreaNormal(a, b, c).norm() / longest : 0;
}

class UnionCleaner {
 public:
  UnionCleaner(SurfaceMesh& mesh, const std::vector<std::vector<Vec3f>>& kept_rings,
               const UnionCleaningOptions& options)
      : mesh_(mesh), options_(options), ring_(mesh.n_vertices(), -1) {
    mesh_.request_vertex_status();
    mesh_.request_edge_status();
    mesh_.request_halfedge_status();
    mesh_.request_face_status();
    for (const CleaningZone& zone : options.zones) {
      max_factor_ = std::max(max_factor_, zone.factor);
    }
    std::map<std::tuple<float, float, float>, int> ring_at;
    for (size_t ring = 0; ring < kept_rings.size(); ++ring) {
      for (const Vec3f& p : kept_rings[ring]) {
        ring_at[{p.x(), p.y(), p.z()}] = static_cast<int>(ring);
      }
    }
    for (const auto v : mesh_.vertices()) {
      const auto& p = mesh_.point(v);
      const auto found = ring_at.find({p[0], p[1], p[2]});
      if (found == ring_at.end()) continue;
      ring_[v.idx()] = found->second;
      mesh_.status(v).set_locked(true);
    }
  }

  void Run() {
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const int changes = CollapseShortEdges() + MendFlatTriangles();
      if (changes == 0) break;
    }
    mesh_.garbage_collection();
  }

 private:
  double Length(HalfEdge h) const {
    return (PointOf(mesh_, mesh_.to_vertex_handle(h)) - PointOf(mesh_, mesh_.from_vertex_handle(h)))
        .norm();
  }

  // The factor of the zone in which a half-edge lies.
  double FactorAt(HalfEdge h) const {
    const Vec3 middle =
        (PointOf(mesh_, mesh_.to_vertex_handle(h)) + PointOf(mesh_, mesh_.from_vertex_handle(h))) /
        2;
    for (const CleaningZone& zone : options_.zones) {
      if ((middle - zone.centre).squaredNorm() <= zone.radius * zone.radius) return zone.factor;
    }
    return 1;
  }

  bool IsShort(HalfEdge h) const {
    const double length = Length(h);
    return length < max_factor_ * options_.min_edge && length < FactorAt(h) * options_.min_edge;
  }

  // The worst cosine between old and new normals when the start of h moves to its end; -2 where the
  // collapse is not allowed.
  double CollapseQuality(HalfEdge h) {
    const Vertex from = mesh_.from_vertex_handle(h);
    const Vertex to = mesh_.to_vertex_handle(h);
    if (mesh_.status(from).locked() || !mesh_.is_collapse_ok(h)) return -2;
    const Vec3 target = PointOf(mesh_, to);
    double worst = 1;
    for (auto out = mesh_.voh_begin(from); out.is_valid(); ++out) {
      const Vertex b = mesh_.to_vertex_handle(*out);
      const Vertex c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(*out));
      if (b == to || c == to) continue;
      const Vec3 pb = PointOf(mesh_, b);
      const Vec3 pc = PointOf(mesh_, c);
      const Vec3 before = AreaNormal(PointOf(mesh_, from), pb, pc);
      const Vec3 after = AreaNormal(target, pb, pc);
      if (after.norm() == 0) return -2;
      if (MinHeight(PointOf(mesh_, from), pb, pc) < options_.min_height) continue;
      worst = std::min(worst, before.dot(after) / (before.norm() * after.norm()));
    }
    return worst;
  }

  bool Collapse(HalfEdge h, double min_cos) {
    const HalfEdge opposite = mesh_.opposite_halfedge_handle(h);
    const double forward = CollapseQuality(h);
    const double backward = CollapseQuality(opposite);
    if (std::max(forward, backward) < min_cos) return false;
    mesh_.collapse(forward >= backward ? h : opposite);
    return true;
  }

  int CollapseShortEdges() {
    std::vector<std::pair<double, int>> candidates;
    for (const auto e : mesh_.edges()) {
      if (mesh_.status(e).deleted()) continue;
      const HalfEdge h = mesh_.halfedge_handle(e, 0);
      if (IsShort(h)) candidates.emplace_back(Length(h), e.idx());
    }
    std::sort(candidates.begin(), candidates.end());
    int changes = 0;
    for (const auto& [length, index] : candidates) {
      const Edge e(index);
      if (mesh_.status(e).deleted()) continue;
      const HalfEdge h = mesh_.halfedge_handle(e, 0);
      if (IsShort(h)) changes += Collapse(h, kMinCosCollapse);
    }
    return changes;
  }

  Vec3 Opposite(HalfEdge h) const {
    return PointOf(mesh_, mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)));
  }

  bool MayFlip(HalfEdge h) {
    const Edge e = mesh_.edge_handle(h);
    const Vertex from = mesh_.from_vertex_handle(h);
    const Vertex to = mesh_.to_vertex_handle(h);
    const bool within_ring = ring_[from.idx()] >= 0 && ring_[from.idx()] == ring_[to.idx()];
    if (within_ring || !mesh_.is_flip_ok(e)) return false;
    const Vec3 a = PointOf(mesh_, from);
    const Vec3 b = PointOf(mesh_, to);
    const Vec3 c = Opposite(h);
    const Vec3 d = Opposite(mesh_.opposite_halfedge_handle(h));
    const Vec3 old_normal = AreaNormal(a, b, c) + AreaNormal(b, a, d);
    const Vec3 first = AreaNormal(c, a, d);
    const Vec3 second = AreaNormal(d, b, c);
    const double cos_first = old_normal.dot(first) / (old_normal.norm() * first.norm());
    const double cos_second = old_normal.dot(second) / (old_normal.norm() * second.norm());
    return cos_first > kMinCosFlip && cos_second > kMinCosFlip &&
           std::min(MinHeight(c, a, d), MinHeight(d, b, c)) >
               std::min(MinHeight(a, b, c), MinHeight(b, a, d));
  }

  // A flat triangle loses its longest edge by a flip, or else its shortest one if that is not much
  // longer than edges may be.
  int MendFlatTriangles() {
    int changes = 0;
    for (const auto face : mesh_.faces()) {
      if (mesh_.status(face).deleted()) continue;
      HalfEdge longest = mesh_.halfedge_handle(face);
      HalfEdge shortest = longest;
      HalfEdge h = longest;
      for (int k = 0; k < 2; ++k) {
        h = mesh_.next_halfedge_handle(h);
        if (Length(h) > Length(longest)) longest = h;
        if (Length(h) < Length(shortest)) shortest = h;
      }
      const Vec3 a = PointOf(mesh_, mesh_.from_vertex_handle(longest));
      const Vec3 b = PointOf(mesh_, mesh_.to_vertex_handle(longest));
      const double height = MinHeight(a, b, Opposite(longest));
      if (height >= max_factor_ * options_.min_height ||
          height >= FactorAt(longest) * options_.min_height) {
        continue;
      }
      if (MayFlip(longest)) {
        mesh_.flip(mesh_.edge_handle(longest));
        ++changes;
      } else if (Length(shortest) < kFlatCollapse * FactorAt(shortest) * options_.min_edge) {
        changes += Collapse(shortest, kMinCosFlip);
      }
    }
    return changes;
  }

  SurfaceMesh& mesh_;
  const UnionCleaningOptions& options_;
  std::vector<int> ring_;  // of each vertex, -1 = none
  double max_factor_ = 1;
};

}  // namespace

std::optional<TriangleMesh> CleanUnion(const UnionMesh& mesh,
                                       const std::vector<std::vector<Vec3f>>& kept_rings,
                                       const UnionCleaningOptions& options) {
  TriangleMesh rounded;
  rounded.triangles = mesh.triangles;
  rounded.vertices.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) rounded.vertices.push_back(v.cast<float>());
  std::optional<SurfaceMesh> surface = ToSurfaceMesh(rounded);
  if (!surface) return std::nullopt;
  UnionCleaner(*surface, kept_rings, options).Run();
  return ToTriangleMesh(*surface);
}

}  // namespace curvefusion
