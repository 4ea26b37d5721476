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

}  // namespace curvefusion
