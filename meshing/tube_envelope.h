#pragma once

#include "meshing/tube_axis.h"

namespace curvefusion {

/// The axis and radii of a smooth tube that fills what all balls along a rough axis fill together.
/// Balls about the zigzag of a noisy curve make a tube that is straighter and thicker than the
/// curve: wherever the curve turns to and fro within a radius, points of the result are the
/// centroids of the balls' common cross-sections, and radii those of circles of the same area.
/// Elsewhere, near both ends, and where the curve as a whole bends too tightly for a cross-section
/// to be one, the axis stays as it is. No two consecutive points may be equal. Linear in points and
/// length over radius.
TubeAxis FitToEnvelope(const TubeAxis& axis);

/// Whether FitToEnvelope finds noise anywhere along the axis.
bool IsNoisy(const TubeAxis& axis);

/// Indices of the inner points, ascending, at which a curve has a corner: it turns by more than .7
/// radians at the point and as a whole. No circle is the cross-section of a tube there. Points next
/// to an end are none.
std::vector<int> FindCorners(const TubeAxis& axis);

/// `fitted`, made of `axis` by FitToEnvelope, with points moved so that its tube reaches as far as
/// the rough one in certain directions: circles of the same area stand out by some hundredths of a
/// radius in one direction and back in another. `ways` holds a unit vector or zero for each segment
/// of `fitted`. Both ends stay. O(points that move times length over radius).
TubeAxis ReachAsFar(const TubeAxis& axis, TubeAxis fitted, const std::vector<Vec3>& ways);

}  // namespace curvefusion
