#include "kernel/observed_points.h"

#include <fmt/format.h>

#include "kernel/error.h"
#include "kernel/quantile.h"

namespace curvefusion {

ObservedPoints Transformed(const ObservedPoints& points, const AffineTransform& T) {
  ObservedPoints transformed = points;
  for (Vec3& p : transformed.positions) p = T * p;
  for (Vec3& ray : transformed.viewing_rays) ray = (T.linear() * ray).normalized();
  return transformed;
}

void Append(ObservedPoints& points, const ObservedPoints& more) {
  points.positions.insert(points.positions.end(), more.positions.begin(), more.positions.end());
  points.viewing_rays.insert(points.viewing_rays.end(), more.viewing_rays.begin(),
                             more.viewing_rays.end());
  points.counts.insert(points.counts.end(), more.counts.begin(), more.counts.end());
}

Vec3 RobustExtent(const ObservedPoints& points) {
  constexpr double kOutliers = 0.01;
  if (points.empty()) return Vec3::Zero();
  Vec3 extent;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coordinates;
    for (const Vec3& p : points.positions) coordinates.push_back(p[axis]);
    extent[axis] = Quantile(coordinates, 1 - kOutliers) - Quantile(coordinates, kOutliers);
  }
  return extent;
}

void RequireFinitePositions(const ObservedPoints& points) {
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points.positions[i];
    if (p.allFinite()) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("point {} of {} is ({}, {}, {}): remove points without a position", i,
                            points.size(), p.x(), p.y(), p.z()));
  }
}

}  // namespace curvefusion
