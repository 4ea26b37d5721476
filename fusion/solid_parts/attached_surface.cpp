#include "fusion/solid_parts/attached_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr double kAxisStep = 2 * kMillimetre;  // chosen: below what a volume resolves
constexpr double kTurnedAway = 0.5;            // cosine; chosen: 60 degrees

// How a triangle lies to the nearest tube.
struct TubeView {
  double distance = std::numeric_limits<double>::infinity();  // metres from its surface
  double outwards = 0;  // cosine between the triangle's normal and the way from the axis
};

std::vector<TubeView> ViewsOf(const SurfaceTriangles& surface, const SkeletonGraph& skeleton) {
  std::vector<Vec3> axis;
  std::vector<double> radii;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    for (size_t i = 0; i + 1 < edge.points.size(); ++i) {
      const Vec3 segment = edge.points[i + 1] - edge.points[i];
      const int steps = std::max(1, static_cast<int>(std::ceil(segment.norm() / kAxisStep)));
      for (int k = 0; k <= steps; ++k) {
        axis.push_back(edge.points[i] + segment * k / steps);
        radii.push_back(edge.radii.empty() ? 0 : edge.radii[i]);
      }
    }
  }
  std::vector<TubeView> views(surface.size());
  if (axis.empty()) return views;
  const PointIndex index(axis);
  ParallelFor(0, static_cast<int64_t>(surface.size()), 256, [&](int64_t i) {
    const int nearest = index.Nearest(surface.centers[i]);
    const Vec3 offset = surface.centers[i] - axis[nearest];
    views[i] = {offset.norm() - radii[nearest], surface.normals[i].dot(offset.normalized())};
  });
  return views;
}

// Distances along the edges of the passable triangles from the vertices of the marked ones.
std::vector<double> DistancesAlong(const SurfaceTriangles& surface, const TriangleMarks& marked,
                                   const TriangleMarks& passable, double reach) {
  const size_t count = surface.mesh.vertices.size();
  std::vector<std::vector<int>> neighbours(count);
  std::vector<double> distance(count, std::numeric_limits<double>::infinity());
  using Step = std::pair<double, int>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> next;
  for (size_t i = 0; i < surface.size(); ++i) {
    const auto& triangle = surface.mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3];
      if (marked[i] && distance[a] > 0) next.push({distance[a] = 0, a});
      if (!passable[i]) continue;
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  }
  while (!next.empty()) {
    const auto [so_far, v] = next.top();
    next.pop();
    if (so_far > distance[v] || so_far > reach) continue;
    for (const int w : neighbours[v]) {
      const double there =
          so_far +
          static_cast<double>((surface.mesh.vertices[v] - surface.mesh.vertices[w]).norm());
      if (there < distance[w]) next.push({distance[w] = there, w});
    }
  }
  return distance;
}

void GrowBack(const SurfaceTriangles& surface, const TriangleMarks& passable, double reach,
              TriangleMarks& marks) {
  const std::vector<double> distance = DistancesAlong(surface, marks, passable, reach);
  for (size_t i = 0; i < surface.size(); ++i) {
    const auto& [a, b, c] = surface.mesh.triangles[i];
    if (passable[i] && std::max({distance[a], distance[b], distance[c]}) <= reach) marks[i] = 1;
  }
}

}  // namespace

TriangleMarks FindAttachedSurface(const SurfaceTriangles& surface, const TriangleMarks& room,
                                  const SkeletonGraph& skeleton, double reach, double blur) {
  const std::vector<TubeView> views = ViewsOf(surface, skeleton);
  TriangleMarks clear(surface.size(), 0), passable(surface.size(), 0);
  for (size_t i = 0; i < surface.size(); ++i) {
    const bool on_tube = views[i].distance < blur && views[i].outwards > kTurnedAway;
    clear[i] = !room[i] && views[i].distance > reach;
    passable[i] = !room[i] && !clear[i] && !on_tube;
  }
  TriangleMarks attached(surface.size(), 0);
  for (const SurfacePiece& piece : PiecesOf(surface, clear)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int i : piece.triangles) nearest = std::min(nearest, views[i].distance);
    const bool is_large = piece.area > std::numbers::pi * reach * reach;
    if (piece.is_cut || !is_large || nearest > reach + blur) continue;
    for (const int i : piece.triangles) attached[i] = 1;
  }
  GrowBack(surface, passable, reach, attached);
  return attached;
}

}  // namespace curvefusion
