#include "fusion/solid_parts/attached_ends.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace curvefusion {

namespace {

// Chosen: a wire's last piece has an end's noise, its direction is that of so much before it.
constexpr double kTangentLength = 15 * kMillimetre;
// Where the straight way misses the surface, within this of it: what a mug's handle turns by in
// `reach`. Cosine of 60 degrees, chosen.
constexpr double kMinCosine = 0.5;

struct Ray {
  Vec3 origin;
  Vec3 direction;
};

// Moeller and Trumbore 1997: how far along the ray the triangle lies; nothing where it is missed.
std::optional<double> HitOf(const Ray& ray, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = ray.direction.cross(c - a);
  const double determinant = p.dot(b - a);
  if (determinant == 0) return std::nullopt;
  const Vec3 t = ray.origin - a;
  const double u = t.dot(p) / determinant;
  const Vec3 q = t.cross(b - a);
  const double v = ray.direction.dot(q) / determinant;
  const double along = q.dot(c - a) / determinant;
  if (u < 0 || v < 0 || u + v > 1 || along < 0) return std::nullopt;
  return along;
}

// Where a wire's end is led to; nothing where it is inside already or the surface too far.
std::optional<Vec3> TargetOf(const Ray& ray, const TriangleMesh& surface, double reach) {
  double ahead = reach, nearest = reach;
  std::optional<Vec3> target, beside;
  bool is_inside = false;
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto [a, b, c] = CornersOf(surface, i);
    const Vec3 offset = (a + b + c) / 3 - ray.origin;
    if (offset.norm() < nearest && offset.dot(ray.direction) > kMinCosine * offset.norm()) {
      nearest = offset.norm();
      beside = ray.origin + offset;
    }
    const std::optional<double> along = HitOf(ray, a, b, c);
    if (!along || *along > ahead) continue;
    ahead = *along;
    target = ray.origin + ahead * ray.direction;
    is_inside = (b - a).cross(c - a).dot(ray.direction) > 0;
  }
  if (is_inside) return std::nullopt;
  return target ? target : beside;
}

Ray RayAtEnd(const Polyline& points) {
  const Vec3& end = points.back();
  size_t before = points.size() - 1;
  while (before > 0 && (points[before] - end).norm() < kTangentLength) --before;
  return {end, (end - points[before]).normalized()};
}

void LeadOn(const SkeletonEdge& given, NodeId end, const Vec3& target, SkeletonGraph& skeleton,
            EdgeId id) {
  SkeletonEdge edge = given;
  if (edge.nodes[1] != end) Reverse(edge);
  edge.points.push_back(target);
  if (!edge.radii.empty()) edge.radii.push_back(edge.radii.back());
  edge.observations.clear();
  skeleton.RemoveEdge(id);
  edge.nodes[1] = skeleton.AddNode(target);
  skeleton.AddEdge(std::move(edge));
}

}  // namespace

SkeletonGraph LedToSolids(SkeletonGraph skeleton, const std::vector<TriangleMesh>& solids,
                          double reach) {
  for (const TriangleMesh& solid : solids) {
    for (const NodeId node : skeleton.Nodes()) {
      if (skeleton.Degree(node) != 1) continue;
      const EdgeId id = skeleton.IncidentEdges(node)[0];
      const SkeletonEdge edge = skeleton.edge(id);
      Polyline points = edge.points;
      if (edge.nodes[1] != node) std::reverse(points.begin(), points.end());
      const std::optional<Vec3> target = TargetOf(RayAtEnd(points), solid, reach);
      if (target && *target != points.back()) LeadOn(edge, node, *target, skeleton, id);
    }
    skeleton.RemoveIsolatedNodes();
  }
  return skeleton;
}

}  // namespace curvefusion
