#pragma once

#include <vector>

#include "kernel/polyline.h"

namespace curvefusion {

/// One step of bending a straight wire: feed it, turn it about its own axis, bend it.
struct Bend {
  double straight = 0;  ///< metres of straight wire before the bend
  double rotation = 0;  ///< radians from the plane of the bend before to this one's, -pi to pi,
                        ///< right-handed about the feeding direction; 0 of the first
  double angle = 0;     ///< radians by which the wire turns
  double radius = 0;    ///< metres, of its centre line; 0 where it is too sharp to tell
  double arc = 0;       ///< metres of centre line in the bend: angle times radius
};

/// A wire as a bender needs it (LRA: length, rotation, angle).
struct BendList {
  std::vector<Bend> bends;
  double end = 0;  ///< metres of straight wire after the last bend
};

/// Bends of a curve, which is made of straight pieces by dropping points (Douglas and Peucker)
/// within `tolerance` (metres, positive). Corners in a row that turn about the same axis, to 20
/// degrees, and whose piece between is as near to an arc as to a straight line, are one bend. All
/// lengths are along the curve, so that straight pieces and arcs add up to its length. A closed
/// curve begins and ends at its first point.
BendList FindBends(const Polyline& points, double tolerance);

}  // namespace curvefusion
