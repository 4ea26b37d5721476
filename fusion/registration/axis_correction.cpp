#include "fusion/registration/axis_correction.h"

#include <vector>

#include "graph/ridge_projection.h"
#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

ObservedPoints MoveToAxis(const ObservedPoints& points, const SkeletonGraph& skeleton,
                          double axis_depth) {
  std::vector<Vec3> curve_points;
  std::vector<double> radii;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    if (edge.radii.empty()) continue;
    curve_points.insert(curve_points.end(), edge.points.begin(), edge.points.end());
    radii.insert(radii.end(), edge.radii.begin(), edge.radii.end());
  }
  std::vector<double> distances(points.size(), 0.0);
  if (curve_points.empty()) return points;
  const PointIndex index(curve_points);
  constexpr int64_t kPointsPerChunk = 256;
  ParallelFor(0, static_cast<int64_t>(points.size()), kPointsPerChunk, [&](int64_t i) {
    distances[i] = axis_depth * radii[index.Nearest(points.positions[i])];
  });
  return ShiftAlongRays(points, distances);
}

}  // namespace curvefusion
