#include "kernel/exact.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "kernel/polyline.h"

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using PredicateKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Number = Kernel::FT;

// Floating point decides where it is sure. All values below come from differences of stored
// coordinates by a few dozen operations, so their error is far below this part of their size.
constexpr double kRelativeError = 1e-13;
// Sizes for which no product below overflows or loses digits to underflow.
constexpr double kSmallest = 1e-100;
constexpr double kLargest = 1e100;

template <class FT>
using Vector = std::array<FT, 3>;

template <class FT>
FT Dot(const Vector<FT>& a, const Vector<FT>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class FT>
Vector<FT> Cross(const Vector<FT>& a, const Vector<FT>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class FT>
Vector<FT> Difference(const Vec3& a, const Vec3& b) {
  return {FT(a[0]) - FT(b[0]), FT(a[1]) - FT(b[1]), FT(a[2]) - FT(b[2])};
}

// The point at a parameter of s minus that at a parameter of t.
template <class FT>
struct Offset {
  Vector<FT> w, u, v;

  explicit Offset(const Segment& s, const Segment& t)
      : w(Difference<FT>(s.a, t.a)), u(Difference<FT>(s.b, s.a)), v(Difference<FT>(t.b, t.a)) {}

  Vector<FT> At(const FT& x, const FT& y) const {
    Vector<FT> offset;
    for (int i = 0; i < 3; ++i) offset[i] = w[i] + x * u[i] - y * v[i];
    return offset;
  }
};

template <class FT>
struct Parameters {
  FT s;
  FT t;
};

template <class FT>
FT GapAt(const LinearGap& gap, const Parameters<FT>& at) {
  return FT(gap.s_at_a) + at.s * (FT(gap.s_at_b) - FT(gap.s_at_a)) + FT(gap.t_at_a) +
         at.t * (FT(gap.t_at_b) - FT(gap.t_at_a));
}

// A square that is cut by few lines.
template <class FT>
using ParameterPolygon = boost::container::small_vector<Parameters<FT>, 8>;

// The part of a convex polygon where a gap is large enough.
template <class FT>
ParameterPolygon<FT> Clipped(const ParameterPolygon<FT>& polygon, const LinearGap& gap,
                             const FT& min_gap) {
  ParameterPolygon<FT> clipped;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Parameters<FT>& here = polygon[i];
    const Parameters<FT>& next = polygon[(i + 1) % polygon.size()];
    const FT excess = GapAt(gap, here) - min_gap;
    const FT next_excess = GapAt(gap, next) - min_gap;
    if (excess >= FT(0)) clipped.push_back(here);
    if ((excess > FT(0) && next_excess < FT(0)) || (excess < FT(0) && next_excess > FT(0))) {
      const FT share = excess / (excess - next_excess);
      clipped.push_back({here.s + share * (next.s - here.s), here.t + share * (next.t - here.t)});
    }
  }
  return clipped;
}

template <class FT>
ParameterPolygon<FT> PolygonBeyond(const std::vector<LinearGap>& gaps, double min_gap) {
  const FT zero(0), one(1);
  ParameterPolygon<FT> polygon = {{zero, zero}, {one, zero}, {one, one}, {zero, one}};
  for (const LinearGap& gap : gaps) polygon = Clipped<FT>(polygon, gap, FT(min_gap));
  return polygon;
}

// Where the lines of both segments are nearest, if they are not parallel. The cross product loses
// fewer digits between lines that nearly are than the determinant of their dot products, which has
// the square of its error; and the second parameter comes from the first, so that what is off is so
// on both (docs/graph.md).
template <class FT>
std::optional<Parameters<FT>> ClosestOnLines(const Offset<FT>& offset) {
  const auto& [w, u, v] = offset;
  const Vector<FT> normal = Cross(u, v);
  const FT squared_sine = Dot(normal, normal);
  if (squared_sine <= FT(0)) return std::nullopt;
  const FT s = Dot(Cross(v, w), normal) / squared_sine;
  const FT t = (Dot(v, w) + s * Dot(u, v)) / Dot(v, v);
  return Parameters<FT>{s, t};
}

// Whether parameters lie in a polygon that is given counter-clockwise. Nothing lies in one without
// area: its sides are all there is of it.
template <class FT>
bool IsInside(const ParameterPolygon<FT>& polygon, const Parameters<FT>& p) {
  FT doubled_area(0);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Parameters<FT>& a = polygon[i];
    const Parameters<FT>& b = polygon[(i + 1) % polygon.size()];
    if ((b.s - a.s) * (p.t - a.t) - (b.t - a.t) * (p.s - a.s) < FT(0)) return false;
    doubled_area += a.s * b.t - a.t * b.s;
  }
  return doubled_area > FT(0);
}

// The nearest parameters on one side of a polygon.
template <class FT>
Parameters<FT> ClosestOnSide(const Offset<FT>& offset, const Parameters<FT>& from,
                             const Parameters<FT>& to) {
  const Vector<FT> start = offset.At(from.s, from.t);
  const Vector<FT> end = offset.At(to.s, to.t);
  const Vector<FT> along = {end[0] - start[0], end[1] - start[1], end[2] - start[2]};
  const FT squared_length = Dot(along, along);
  if (squared_length <= FT(0)) return from;
  const FT share = -Dot(start, along) / squared_length;
  if (share <= FT(0)) return from;
  if (share >= FT(1)) return to;
  return {from.s + share * (to.s - from.s), from.t + share * (to.t - from.t)};
}

// The nearest parameters in a polygon that is not empty: where the lines are nearest or on a side.
template <class FT>
Parameters<FT> ClosestInPolygon(const Offset<FT>& offset, const ParameterPolygon<FT>& polygon) {
  const auto on_lines = ClosestOnLines(offset);
  if (on_lines && IsInside(polygon, *on_lines)) return *on_lines;
  Parameters<FT> closest = polygon[0];
  Vector<FT> apart = offset.At(closest.s, closest.t);
  FT least = Dot(apart, apart);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Parameters<FT> here =
        ClosestOnSide(offset, polygon[i], polygon[(i + 1) % polygon.size()]);
    apart = offset.At(here.s, here.t);
    const FT squared_distance = Dot(apart, apart);
    if (squared_distance < least) {
      least = squared_distance;
      closest = here;
    }
  }
  return closest;
}

bool ExactlyWithinBeyond(const Segment& s, const Segment& t, double distance,
                         const std::vector<LinearGap>& gaps, double min_gap) {
  const ParameterPolygon<Number> polygon = PolygonBeyond<Number>(gaps, min_gap);
  if (polygon.empty()) return false;
  const Offset<Number> offset(s, t);
  const Parameters<Number> closest = ClosestInPolygon(offset, polygon);
  const Vector<Number> apart = offset.At(closest.s, closest.t);
  return Dot(apart, apart) <= Number(distance) * Number(distance);
}

// What floating point can say of the distance of two segments: `apart` is an offset between points
// of both, `least` the smallest product of any offset with it. All offsets lie beyond the plane
// across `apart` at least / |apart|, which bounds the distance from below; |apart| does from above.
std::optional<bool> RoundedIsWithin(const Vector<double>& apart, double least, double size,
                                    double distance) {
  if (!(size > kSmallest && size < kLargest && distance < kLargest)) return std::nullopt;
  const double margin = kRelativeError * (size + distance);
  const double length = std::sqrt(Dot(apart, apart));
  if (length + margin < distance) return true;
  if (least > length * (distance + margin) + margin * length) return false;
  return std::nullopt;
}

double LargestCoordinate(const Vector<double>& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

double SizeOf(const Offset<double>& offset) {
  return LargestCoordinate(offset.w) + LargestCoordinate(offset.u) + LargestCoordinate(offset.v);
}

std::optional<bool> RoundedWithin(const Segment& s, const Segment& t, double distance) {
  const ClosestParameters at = ClosestPoints(s.a, s.b, t.a, t.b);
  const Offset<double> offset(s, t);
  if (SizeOf(offset) == 0) return true;  // the same point
  const Vector<double> apart = offset.At(at.s, at.t);
  const double least = Dot(offset.w, apart) + std::min(0.0, Dot(offset.u, apart)) -
                       std::max(0.0, Dot(offset.v, apart));
  return RoundedIsWithin(apart, least, SizeOf(offset), distance);
}

std::optional<bool> RoundedWithinBeyond(const Segment& s, const Segment& t, double distance,
                                        const std::vector<LinearGap>& gaps, double min_gap) {
  const ParameterPolygon<double> polygon = PolygonBeyond<double>(gaps, min_gap);
  if (polygon.size() < 3) return std::nullopt;
  const Offset<double> offset(s, t);
  const Parameters<double> at = ClosestInPolygon(offset, polygon);
  const Vector<double> apart = offset.At(at.s, at.t);
  double least = std::numeric_limits<double>::infinity();
  for (const Parameters<double>& corner : polygon)
    least = std::min(least, Dot(offset.At(corner.s, corner.t), apart));
  // Corners of the polygon are as uncertain as the gaps, which may be longer than the segments.
  double size = SizeOf(offset) + std::abs(min_gap);
  for (const LinearGap& gap : gaps)
    size += std::max(std::abs(gap.s_at_a), std::abs(gap.s_at_b)) +
            std::max(std::abs(gap.t_at_a), std::abs(gap.t_at_b));
  return RoundedIsWithin(apart, least, size, distance);
}

PredicateKernel::Point_3 ToPoint(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

bool AreWithin(const Segment& s, const Segment& t, double distance) {
  const std::optional<bool> rounded = RoundedWithin(s, t, distance);
  return rounded ? *rounded : ExactlyWithinBeyond(s, t, distance, {}, 0);
}

bool Intersect(const Segment& s, const Segment& t) {
  const std::optional<bool> rounded = RoundedWithin(s, t, 0);
  if (rounded) return *rounded;
  if (s.a == s.b || t.a == t.b) return ExactlyWithinBeyond(s, t, 0, {}, 0);
  return CGAL::do_intersect(PredicateKernel::Segment_3(ToPoint(s.a), ToPoint(s.b)),
                            PredicateKernel::Segment_3(ToPoint(t.a), ToPoint(t.b)));
}

bool Overlap(const Vec3& common, const Vec3& p, const Vec3& q) {
  assert(common != p && common != q);
  const PredicateKernel::Point_3 c = ToPoint(common);
  const Vec3 u = p - common;
  const Vec3 v = q - common;
  const double size = u.cwiseAbs().maxCoeff() * v.cwiseAbs().maxCoeff();
  if (size > kSmallest && size < kLargest) {
    if (u.dot(v) < -kRelativeError * size) return false;
    if (u.cross(v).cwiseAbs().maxCoeff() > kRelativeError * size) return false;
  }
  return CGAL::collinear(c, ToPoint(p), ToPoint(q)) &&
         !CGAL::collinear_are_ordered_along_line(ToPoint(p), c, ToPoint(q));
}

bool AreWithinBeyond(const Segment& s, const Segment& t, double distance,
                     const std::vector<LinearGap>& gaps, double min_gap) {
  const std::optional<bool> rounded = RoundedWithinBeyond(s, t, distance, gaps, min_gap);
  return rounded ? *rounded : ExactlyWithinBeyond(s, t, distance, gaps, min_gap);
}

ClosestParameters ClosestPoints(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto on_lines = ClosestOnLines(Offset<double>({a, b}, {c, d}));
  ClosestParameters nearest;
  if (on_lines) nearest.s = std::clamp(on_lines->s, 0.0, 1.0);
  nearest.t = ClosestParameter(c, d, a + nearest.s * (b - a));
  nearest.s = ClosestParameter(a, b, c + nearest.t * (d - c));
  return nearest;
}

double ClosestDistance(const Segment& s, const Segment& t) {
  const ClosestParameters at = ClosestPoints(s.a, s.b, t.a, t.b);
  return (s.a + at.s * (s.b - s.a) - t.a - at.t * (t.b - t.a)).norm();
}

ClosestParameters ClosestPointsBeyond(const Segment& s, const Segment& t,
                                      const std::vector<LinearGap>& gaps, double min_gap) {
  const ParameterPolygon<double> polygon = PolygonBeyond<double>(gaps, min_gap);
  if (gaps.empty() || polygon.empty()) return ClosestPoints(s.a, s.b, t.a, t.b);
  const Parameters<double> closest = ClosestInPolygon(Offset<double>(s, t), polygon);
  return {closest.s, closest.t};
}

}  // namespace curvefusion
