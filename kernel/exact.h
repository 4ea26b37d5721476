#pragma once

#include "kernel/geometry.h"

namespace curvefusion {

/// The part of the segment from a to b between the fractions first/count and last/count of it; by
/// default all of it. The fractions are taken exactly, so parts of one segment abut. a == b is a
/// point.
struct SegmentPart {
  Vec3 a;
  Vec3 b;
  int first = 0;
  int last = 1;
  int count = 1;
};

/// Whether two segments come within a distance of each other, limit included. Decided exactly on
/// the stored coordinates: no rounding, no tolerance. All values must be finite, distance >= 0.
bool AreWithin(const SegmentPart& s, const SegmentPart& t, double distance);

/// Whether two segments have a point in common, decided exactly.
bool Intersect(const SegmentPart& s, const SegmentPart& t);

/// The nearest points of two segments as their parameters in [0, 1], in floating point: for
/// placing points, not for decisions.
struct ClosestParameters {
  double s = 0;
  double t = 0;
};
ClosestParameters ClosestPoints(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace curvefusion
