#include "meshing/closest_approach.h"

#include <cmath>

#include "kernel/polyline.h"

namespace curvefusion {

namespace {

Vec3 NearestPoint(const LineSegment& segment, const Vec3& p) {
  return segment.a + ClosestParameter(segment.a, segment.b, p) * (segment.b - segment.a);
}

}  // namespace

double DistanceFrom(const LineSegment& segment, const Vec3& p) {
  return (NearestPoint(segment, p) - p).norm();
}

// Either an end is nearest, or the inner points of a common perpendicular.
ClosestApproach FindClosestApproach(const LineSegment& first, const LineSegment& second) {
  ClosestApproach closest{(first.a - second.a).norm(), first.a, second.a};
  const auto consider = [&closest](const Vec3& on_first, const Vec3& on_second) {
    const double distance = (on_first - on_second).norm();
    if (distance < closest.distance) closest = {distance, on_first, on_second};
  };
  for (const Vec3& p : {first.a, first.b}) consider(p, NearestPoint(second, p));
  for (const Vec3& p : {second.a, second.b}) consider(NearestPoint(first, p), p);
  const Vec3 u = first.b - first.a;
  const Vec3 v = second.b - second.a;
  const Vec3 w = second.a - first.a;
  const Vec3 normal = u.cross(v);
  const double square = normal.squaredNorm();
  if (square <= 1e-20 * u.squaredNorm() * v.squaredNorm()) return closest;
  const double along_first = w.cross(v).dot(normal) / square;
  const double along_second = w.cross(u).dot(normal) / square;
  if (along_first < 0 || along_first > 1 || along_second < 0 || along_second > 1) return closest;
  const double distance = std::abs(w.dot(normal)) / std::sqrt(square);
  if (distance < closest.distance) {
    closest = {distance, first.a + along_first * u, second.a + along_second * v};
  }
  return closest;
}

}  // namespace curvefusion
