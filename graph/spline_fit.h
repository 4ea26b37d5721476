#pragma once

#include <array>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

inline constexpr int kSplineDegree = 3;  ///< chosen: the least without jumps of curvature

/// A cubic B-spline with clamped ends: it begins at its first control point and ends at its last.
struct CubicSpline {
  std::vector<double> knots;  ///< ascending, the ends four times; as many as points, and four more
  std::vector<Vec3> points;   ///< control points, at least four; metres
  std::vector<double> radii;  ///< one a control point, metres; empty where the edge has none
  double deviation = 0;       ///< metres between spline and polyline at most, see FitSpline

  /// The curve at a parameter within the knots.
  Vec3 At(double parameter) const;
};

/// Fits a cubic B-spline to the polyline of an edge by least squares over arc length: knots are
/// halved in until all of it lies within `tolerance` (metres, positive), then those that the
/// tolerance does not need are taken out. Both ends are exact, bit for bit. The deviation is
/// measured at points at most a tolerance apart (of very long curves a 20,000th of the length) and
/// between them, each against the place of the polyline at the same parameter, so that it bounds
/// how far either is from the other there. A polyline that no such spline meets becomes one of
/// straight pieces, deviation 0. Radii are fitted with the same knots, without a tolerance. The
/// spline of a closed edge need not be smooth at its node.
CubicSpline FitSpline(const SkeletonEdge& edge, double tolerance);

/// The same curve as Bezier pieces: x, y, z and radius (0 where there is none) of 3 n + 1 control
/// points, n pieces that share their ends.
std::vector<Eigen::Vector4d> BezierPoints(const CubicSpline& spline);

}  // namespace curvefusion
