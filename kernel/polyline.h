#pragma once

#include <utility>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// An open polygonal curve: at least one point, in metres. A closed curve repeats its first point.
using Polyline = std::vector<Vec3>;

/// Sum of the segment lengths.
double Length(const Polyline& points);

/// Arc length at every vertex; front() is 0, back() the length.
std::vector<double> CumulativeLength(const Polyline& points);

/// Points at equal arc-length steps as near to `step` as divides the length evenly. Both ends are
/// kept bit for bit; a polyline of positive length gives at least two points.
Polyline Resample(const Polyline& points, double step);

/// The nearest point of the segment [a, b] to p, as its parameter in [0, 1].
double ClosestParameter(const Vec3& a, const Vec3& b, const Vec3& p);

/// The nearest point of a polyline to p: arc length from the front, and distance.
struct PolylineProjection {
  double arc_length = 0;
  double distance = 0;
};
PolylineProjection Project(const Polyline& points, const Vec3& p);

/// The point at an arc length, clamped to the ends.
Vec3 PointAt(const Polyline& points, const std::vector<double>& cumulative_length,
             double arc_length);

/// Unit tangents at the vertices (central differences, one-sided at the ends); zero where
/// undefined.
std::vector<Vec3> Tangents(const Polyline& points);

}  // namespace curvefusion
