#include "meshing/ball_rings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/douglas_peucker.h"

namespace curvefusion {

namespace {

// In radii.
constexpr double kStep = 0.05;  // rings to choose from
constexpr double kTolerance = 0.003;

Vec3 OffsetBetween(const Ring& first, const Ring& last, double t, size_t corner) {
  return first.offsets[corner] + t * (last.offsets[corner] - first.offsets[corner]);
}

Ring Between(const Ring& first, const Ring& last, double t) {
  Ring ring = first;
  ring.centre += t * (last.centre - first.centre);
  ring.radius += t * (last.radius - first.radius);
  for (size_t k = 0; k < ring.offsets.size(); ++k) {
    ring.offsets[k] = OffsetBetween(first, last, t, k);
  }
  return ring;
}

// How far the corners of ring k are from where the strip between rings a and b has them, in radii.
double DeviationFromStrip(const std::vector<Ring>& rings, size_t a, size_t k, size_t b) {
  const double t = static_cast<double>(k - a) / static_cast<double>(b - a);
  double deviation = 0;
  for (size_t corner = 0; corner < rings[k].offsets.size(); ++corner) {
    const Vec3 offset = OffsetBetween(rings[a], rings[b], t, corner);
    deviation = std::max(deviation, (rings[k].offsets[corner] - offset).squaredNorm());
  }
  return std::sqrt(deviation) / rings[k].radius;
}

}  // namespace

double ExtentOfBalls(const TubeAxis& balls, const Vec3& from, const Vec3& ray) {
  double extent = 0;
  for (size_t i = 0; i < balls.points.size(); ++i) {
    const Vec3 to_centre = balls.points[i] - from;
    const double middle = to_centre.dot(ray);
    const double radius = balls.radii[i];
    const double square = radius * radius - to_centre.squaredNorm() + middle * middle;
    if (square > 0) extent = std::max(extent, middle + std::sqrt(square));
  }
  return extent;
}

Ring OntoBalls(Ring ring, const TubeAxis& balls, double greatest) {
  for (Vec3& offset : ring.offsets) {
    const Vec3 ray = offset.normalized();
    const double extent = ExtentOfBalls(balls, ring.centre, ray);
    if (extent > 0) offset = std::min(extent, greatest) * ray;
  }
  return ring;
}

std::vector<Ring> RingsBetween(const Ring& first, const Ring& last, const Ring& shaped_first,
                               const Ring& shaped_last, const TubeAxis& balls) {
  const double length = (last.centre - first.centre).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length / (kStep * first.radius))));
  std::vector<Ring> rings = {shaped_first};
  for (int i = 1; i < steps; ++i) {
    const Ring ring = Between(first, last, static_cast<double>(i) / steps);
    rings.push_back(OntoBalls(ring, balls, kGreatestExtent * ring.radius));
  }
  rings.push_back(shaped_last);
  const std::vector<size_t> enough = DouglasPeucker(
      rings.size(), kTolerance,
      [&rings](size_t a, size_t k, size_t b) { return DeviationFromStrip(rings, a, k, b); });
  std::vector<Ring> kept;
  for (size_t i = 1; i + 1 < enough.size(); ++i) kept.push_back(std::move(rings[enough[i]]));
  return kept;
}

}  // namespace curvefusion
