#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// A straight segment; a == b is a point. All coordinates must be finite.
struct Segment {
  Vec3 a;
  Vec3 b;
};

/// Whether two segments come within a distance of each other, limit included. Decided exactly on
/// the stored coordinates: no rounding, no tolerance. distance >= 0.
bool AreWithin(const Segment& s, const Segment& t, double distance);

/// Whether two segments have a point in common, decided exactly.
bool Intersect(const Segment& s, const Segment& t);

/// Whether the segments from `common` to p and from `common` to q have more than that point in
/// common, decided exactly. p and q must differ from `common`.
bool Overlap(const Vec3& common, const Vec3& p, const Vec3& q);

/// A length that grows linearly along two segments: for the points at the parameters x of s and y
/// of t it is s_at_a + x (s_at_b - s_at_a) + t_at_a + y (t_at_b - t_at_a).
struct LinearGap {
  double s_at_a;
  double s_at_b;
  double t_at_a;
  double t_at_b;
};

/// Whether two segments have points within a distance of each other, limit included, for which
/// every gap is at least `min_gap`. Decided exactly on the stored numbers.
bool AreWithinBeyond(const Segment& s, const Segment& t, double distance,
                     const std::vector<LinearGap>& gaps, double min_gap);

/// The nearest points of two segments as their parameters in [0, 1], in floating point: for
/// placing points, not for decisions.
struct ClosestParameters {
  double s = 0;
  double t = 0;
};
ClosestParameters ClosestPoints(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// How far apart those points are, likewise not for decisions.
double ClosestDistance(const Segment& s, const Segment& t);

/// The nearest points among those for which every gap is at least `min_gap`, in floating point.
/// Where there are none, the nearest points of all.
ClosestParameters ClosestPointsBeyond(const Segment& s, const Segment& t,
                                      const std::vector<LinearGap>& gaps, double min_gap);

}  // namespace curvefusion
