#pragma once

#include "kernel/observed_points.h"

namespace curvefusion {

/// The L1Options::initial_radius that fits a cloud of unknown scale: the radius at which the
/// neighbourhoods of its points are most elongated, compared to their thickness, before they reach
/// the next wire; at most 2.5 times the thickness, the paper's ratio (15 mm for wires of 5 mm that
/// measure 6 mm with noise). Where nothing is elongated, the value of Huang et al. 2013, 4.1:
/// 2 diagonals of the bounding box over the cube root of the number of points. The box is that of
/// RobustExtent. In the unit of the cloud; 0 for a cloud without extent. Throws Error(kBadInput)
/// for a point that is not finite.
double SuggestedRadius(const ObservedPoints& points);

}  // namespace curvefusion
