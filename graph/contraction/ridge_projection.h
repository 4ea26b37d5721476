#pragma once

#include <vector>

#include "graph/contraction/ridge_contrast.h"
#include "graph/contraction/ridge_points.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// How points are moved onto the ridges of their density. Deviation: CurveFusion 4.2 contracts to
/// the L1 axis with a kernel of 15 to 25 mm, which merges wires nearer than that.
struct RidgeProjectionOptions {
  double kernel_sigma = 0.0035;
  double max_sigma = 0.007;
  double sigma_per_thickness = 1.3;
  /// Metres: counts are divided by what is usual so near, so that parts seen seldom hold their own
  /// beside parts seen often.
  double equalization_radius = 0.01;
  double spacing = 0.0015;
  double min_relative_strength = 0.05;
  double strength_radius = 0.01;  ///< metres: neighbourhood in which ridge points are compared
  double min_local_strength = 0.4;
  double max_elongation = 1.6;
  double stretch = 2;
  double max_flatness = 0.85;
  RidgeContrastOptions contrast;
};
void VisitOptions(RidgeProjectionOptions& options, OptionVisitor& visitor);

/// Moves every point `distance` along its viewing ray: a depth camera sees only the near side of a
/// wire, so its points lie in front of the axis by pi/4 radii on average. Points without a ray
/// stay.
ObservedPoints ShiftAlongRays(const ObservedPoints& points, double distance);

/// The same with one distance for every point; distances.size() must be points.size().
ObservedPoints ShiftAlongRays(const ObservedPoints& points, const std::vector<double>& distances);

/// Subspace-constrained mean shift (Ozertem and Erdogmus 2011): moves points across the local
/// principal direction only, until they lie on a ridge of the density, and thins them out. Kernels
/// are wider where the wire is thick, and longer along the ridge than across. Points that are not
/// finite are ignored. The result does not depend on the number of threads. Costs O(n k) for k
/// points within three kernel widths.
RidgePoints ProjectToRidges(const ObservedPoints& points, const RidgeProjectionOptions& options);

/// The ridges of points that have been moved a little, or had others added, since `before` were
/// found in them or in parts of them with the same options. Ridges that are in none of those are
/// not found. A fifth of the time of ProjectToRidges.
RidgePoints FollowRidges(const ObservedPoints& points, const RidgePoints& before,
                         const RidgeProjectionOptions& options);

}  // namespace curvefusion
