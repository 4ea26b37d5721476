#include "experiments/metrics/normal_error.h"

#include <algorithm>
#include <cmath>

#include "experiments/metrics/curve_metrics.h"
#include "kernel/angle.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Farther from the truth a surface is another thing, not a rough one: the distance of F5.
constexpr double kReach = 5 * kMillimetre;
// Of a wire of 3 mm, so that the axis sampled at such steps tilts normals by less than 2 degrees.
constexpr double kAxisStep = 0.1 * kMillimetre;

}  // namespace

std::optional<double> MeanNormalError(const TriangleMesh& mesh, const SkeletonGraph& truth) {
  const SkeletonSamples axis = SampleSkeleton(truth, kAxisStep);
  if (axis.positions.empty()) return std::nullopt;
  const PointIndex index(axis.positions);
  double sum = 0, area = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = CornersOf(mesh, i);
    const Vec3 normal = (b - a).cross(c - a);  // twice the area long
    const Vec3 center = (a + b + c) / 3;
    const int nearest = index.Nearest(center);
    const Vec3 outward = center - axis.positions[nearest];
    if (std::abs(outward.norm() - axis.radii[nearest]) > kReach) continue;
    sum += normal.norm() / 2 * AngleBetween(normal, outward);
    area += normal.norm() / 2;
  }
  return area > 0 ? std::optional(sum / area) : std::nullopt;
}

}  // namespace curvefusion
