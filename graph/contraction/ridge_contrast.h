#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"
#include "kernel/point_grid.h"

namespace curvefusion {

/// When a ridge is noise beside stronger wires. Deviation: CurveFusion has no such test.
struct RidgeContrastOptions {
  double ball_radius = 0.004;
  double flank_distance = 0.010;
  double neighbourhood = 0.025;
  double max_flank = 0.3;
  double min_share = 0.3;
};
void VisitOptions(RidgeContrastOptions& options, OptionVisitor& visitor);

/// What was seen of a place: the sum of the counts of the points within a radius of it, metres. The
/// grid is that of the points.
double CountWithin(const PointGrid& grid, const std::vector<float>& counts, const Vec3& center,
                   double radius);

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
