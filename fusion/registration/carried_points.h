#pragma once

#include "fusion/registration/alignment.h"
#include "graph/contraction/ridge_skeleton.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// How the points of all bundles are brought together before one contraction.
struct CarriedPointsOptions {
  double voxel_size = 0.0025;
  double min_inliers = 0.3;
};
void VisitOptions(CarriedPointsOptions& options, OptionVisitor& visitor);

/// How the ridges are found by which bundles are registered (CarriedPoints): farther apart than
/// those of curves.
inline RidgeProjectionOptions ForBundles(RidgeProjectionOptions options) {
  // Measured: 2 saves .1 s of 30 frames and costs 7 of 2096 junctions
  // (docs/lab_notebook.md#time-and-frames-left-out).
  constexpr double kBundleSpacing = 1.5;
  options.spacing *= kBundleSpacing;
  return options;
}

/// The points of all bundles so far, every bundle registered to the curves of those before it.
/// Deviation: the paper averages the skeletons of bundles; carrying the points and contracting once
/// keeps what single bundles are too sparse or too noisy to show. The curves stay the primitive to
/// which every bundle is registered.
class CarriedPoints {
 public:
  explicit CarriedPoints(const CarriedPointsOptions& options) : options_(options) {}

  /// Registers the ridges found in a bundle (world frame) to those of the bundles before and adds
  /// both its points and its ridges; where wires are dense, most points lie between them and say
  /// nothing. Ridge points nearer than `spacing` to stronger ones are left out. The returned
  /// alignment is the identity for the first bundle and where too few points fit. `array_spacing`
  /// is that of AlignArrays.
  AlignmentResult AddBundle(const ObservedPoints& bundle, const RidgePoints& found, double spacing,
                            const AlignmentOptions& alignment, double array_spacing = 0);

  const ObservedPoints& points() const { return points_; }

  /// Those of single bundles: where these overlap, FollowRidges leads to those of all points.
  const RidgePoints& ridges() const { return ridges_; }

 private:
  CarriedPointsOptions options_;
  ObservedPoints points_;
  RidgePoints ridges_;
};

}  // namespace curvefusion
