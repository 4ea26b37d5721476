#pragma once

#include "fusion/registration/alignment.h"
#include "graph/contraction/ridge_projection.h"

namespace curvefusion {

/// By how much points are magnified before contraction: the lengths of contraction are made for
/// wires no nearer than `resolved` (metres) to one another. 1 where `array_spacing` is no less, or
/// 0, that is not known; 2 at most, as noise is magnified too.
double Magnification(double array_spacing, double resolved);

/// The options with all lengths divided by a magnification.
RidgeProjectionOptions ForCloseWires(RidgeProjectionOptions options, double magnification);

/// AlignPoints for ridges of a wire array so close that drift may bring each next to its
/// neighbour: starts `array_spacing` (metres) to either side across the wires are tried too, and
/// the best is taken that clearly more points agree with. An array_spacing of 0 is AlignPoints.
AlignmentResult AlignArrays(const RidgePoints& ridges, const AlignmentTarget& target,
                            const AlignmentOptions& options, double array_spacing);

}  // namespace curvefusion
