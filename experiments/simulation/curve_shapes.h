#pragma once

#include <functional>

#include "experiments/simulation/objects.h"

namespace curvefusion {

// Shapes the objects are bent from. Lengths in millimetres, as their drawings have them.

/// An open wire through points.
WireCurve Wire(const Polyline& points_mm, double diameter_mm);

/// A wire welded into a loop; the first point is not repeated in the argument.
WireCurve Loop(const Polyline& points_mm, double diameter_mm);

/// A circle in the plane z, as `count` points from angle 0.
Polyline CirclePoints(double radius_mm, double z_mm, int count = 180);

/// A rectangle in the xy plane about the origin with rounded corners, counter-clockwise from the
/// corner in the first quadrant.
Polyline RoundedRectangle(double width_mm, double height_mm, double corner_radius_mm);

/// `count` values from first to last, both included.
std::vector<double> Linspace(double first, double last, int count);

/// A periodic C2 cubic spline through `knots` (not repeated), parameterised by chord length, as
/// `count` points at equal steps of the parameter.
Polyline PeriodicSpline(const std::vector<Vec2>& knots, int count);

}  // namespace curvefusion
