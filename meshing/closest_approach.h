#pragma once

#include "kernel/geometry.h"

namespace curvefusion {

struct LineSegment {
  Vec3 a, b;
};

/// Where two segments are nearest to each other.
struct ClosestApproach {
  double distance = 0;
  Vec3 on_first = Vec3::Zero();
  Vec3 on_second = Vec3::Zero();
};

/// Of parallel segments one of the nearest pairs of points.
ClosestApproach FindClosestApproach(const LineSegment& first, const LineSegment& second);

/// The distance of a point from a segment.
double DistanceFrom(const LineSegment& segment, const Vec3& p);

}  // namespace curvefusion
