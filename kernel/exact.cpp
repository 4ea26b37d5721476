#include "kernel/exact.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <cassert>

#include "kernel/polyline.h"

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;

Point ToPoint(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

// The point at the fraction k/count of a segment, without rounding.
Point PointAtFraction(const SegmentPart& part, int k) {
  if (k == 0) return ToPoint(part.a);
  if (k == part.count) return ToPoint(part.b);
  const Point a = ToPoint(part.a);
  return a + (ToPoint(part.b) - a) * (Number(k) / Number(part.count));
}

Segment ToSegment(const SegmentPart& part) {
  assert(part.a.allFinite() && part.b.allFinite());
  return {PointAtFraction(part, part.first), PointAtFraction(part, part.last)};
}

}  // namespace

bool AreWithin(const SegmentPart& s, const SegmentPart& t, double distance) {
  const Number limit(distance);
  return CGAL::squared_distance(ToSegment(s), ToSegment(t)) <= limit * limit;
}

bool Intersect(const SegmentPart& s, const SegmentPart& t) { return AreWithin(s, t, 0); }

ClosestParameters ClosestPoints(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = d - c;
  const Vec3 w = a - c;
  const double uu = u.squaredNorm();
  const double uv = u.dot(v);
  const double vv = v.squaredNorm();
  const double determinant = uu * vv - uv * uv;
  ClosestParameters nearest;
  if (determinant > 1e-12 * uu * vv)
    nearest.s = std::clamp((uv * v.dot(w) - vv * u.dot(w)) / determinant, 0.0, 1.0);
  nearest.t = ClosestParameter(c, d, a + nearest.s * u);
  nearest.s = ClosestParameter(a, b, c + nearest.t * v);
  return nearest;
}

}  // namespace curvefusion
