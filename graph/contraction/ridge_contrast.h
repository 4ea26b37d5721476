#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// When a ridge is noise beside stronger wires. Deviation: CurveFusion has no such test.
struct RidgeContrastOptions {
  double ball_radius = 0.004;     ///< metres: what was seen of a place are the points so near to it
  double flank_distance = 0.010;  ///< metres: how far beside a ridge noise is looked for
  double neighbourhood = 0.025;   ///< metres: a ridge is compared with the best one so near
  double min_share = 0.3;
};
void VisitOptions(RidgeContrastOptions& options, OptionVisitor& visitor);

/// For each place on a ridge of unit direction, whether it is a wire of its own: nearly as much was
/// seen there as at the best place in the neighbourhood, or hardly anything on one of two opposite
/// sides: beside it as the camera saw it, or whichever way across where the rays are not known or
/// do not agree. Between wires the sensor scatters points that make weak ridges but
/// fill both sides; a wire seen seldom has a clear side. What was seen of a place are the counts
/// within a ball. directions.size() must be places.size(). Costs O(n k) for k points in a ball.
std::vector<char> StandsOut(const ObservedPoints& points, const std::vector<Vec3>& places,
                            const std::vector<Vec3>& directions,
                            const RidgeContrastOptions& options);

}  // namespace curvefusion
