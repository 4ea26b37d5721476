#include "fusion/registration/axis_correction.h"

#include "graph/contraction/ridge_projection.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int64_t kPointsPerChunk = 256;  // for a thread at a time; chosen
// Chosen: within this distance, metres, nearly all points have their curve.
constexpr double kUsualDistance = 0.01;
constexpr double kCellSize = 0.004;  // most have it within this

Polyline PointsWithRadii(const SkeletonGraph& skeleton) {
  Polyline points;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    if (!edge.radii.empty()) points.insert(points.end(), edge.points.begin(), edge.points.end());
  }
  return points;
}

}  // namespace

AxisCorrection::AxisCorrection(const SkeletonGraph& skeleton, double axis_depth)
    : AxisCorrection(skeleton, axis_depth, PointsWithRadii(skeleton)) {}

AxisCorrection::AxisCorrection(const SkeletonGraph& skeleton, double axis_depth,
                               const Polyline& curve_points)
    : near_(curve_points, kCellSize), all_(curve_points) {
  for (const EdgeId id : skeleton.Edges()) {
    for (const double radius : skeleton.edge(id).radii) distances_.push_back(axis_depth * radius);
  }
}

ObservedPoints AxisCorrection::Apply(const ObservedPoints& points) const {
  if (distances_.empty()) return points;
  std::vector<double> distances(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), kPointsPerChunk, [&](int64_t i) {
    int nearest = near_.Nearest(points.positions[i], kUsualDistance);
    if (nearest < 0) nearest = all_.Nearest(points.positions[i]);
    distances[i] = distances_[nearest];
  });
  return ShiftAlongRays(points, distances);
}

}  // namespace curvefusion
