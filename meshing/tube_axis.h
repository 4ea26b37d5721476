#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// A polyline with the tube's radius at every point, in metres.
struct TubeAxis {
  Polyline points;
  std::vector<double> radii;
};

/// How a noisy polyline becomes the axis of a tube; lengths in local radii.
struct AxisOptions {
  double tolerance = 0.02;       ///< the simplified axis follows the given one within this
  double min_spacing = 0.15;     ///< least distance of consecutive points
  double kink_tolerance = 0.05;  ///< the same where a tube could not be swept otherwise
  double max_turn = 0.785;       ///< radians, at one point of a swept tube
};

/// How far point k lies from the chord between points a and b, in radii of point k; the radius
/// counts like a coordinate.
double ChordDeviation(const TubeAxis& axis, size_t a, size_t k, size_t b);

/// Lets the points of another axis follow those of `axis`.
void AppendAxis(const TubeAxis& tail, TubeAxis& axis);

/// `axis` without points equal to their predecessor.
TubeAxis WithoutRepeatedPoints(const TubeAxis& axis);

/// `axis` without noise (FitToEnvelope) and without points equal to their predecessor. Both ends
/// are kept bit for bit.
TubeAxis SmoothAxis(const TubeAxis& axis);

/// The fewest points that follow `axis` (position and radius) within the tolerance
/// (Douglas-Peucker), thinned to the least spacing and, within the wider tolerance, until no tube
/// along them has to be cut for a kink; then moved half way to where they fit it best, so that
/// bends do not get shorter. Both ends are kept bit for bit. No two consecutive points may be
/// equal.
TubeAxis SimplifyAxis(const TubeAxis& axis, const AxisOptions& options);

/// The angle by which a polyline turns at an inner point.
double TurnAngleAt(const Polyline& points, size_t i);

/// Whether the strip of a tube between two mitred rings would fold over: the rings lie `length`
/// apart, and the axis turns by these angles at them.
bool StripFolds(double length, double radius, double first_turn, double last_turn);

/// Indices of the inner points, ascending, at which a swept tube must be cut into pieces: the axis
/// turns by more than `max_turn` radians, a strip would fold, or the radius jumps.
std::vector<int> FindCuts(const TubeAxis& axis, double max_turn);

/// The points first..last (inclusive) of an axis.
TubeAxis Slice(const TubeAxis& axis, int first, int last);

/// `axis` with points added evenly where consecutive points lie more than `max_spacing` local radii
/// apart.
TubeAxis SubdivideAxis(const TubeAxis& axis, double max_spacing);

}  // namespace curvefusion
