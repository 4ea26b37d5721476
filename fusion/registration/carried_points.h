#pragma once

#include "fusion/registration/alignment.h"
#include "graph/ridge_skeleton.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// How the points of all bundles are brought together before one contraction.
struct CarriedPointsOptions {
  double voxel_size = 0.0025;
  double min_inliers = 0.3;
};
void VisitOptions(CarriedPointsOptions& options, OptionVisitor& visitor);

/// The points of all bundles so far, every bundle registered to the curves of those before it.
/// Deviation: the paper averages the skeletons of bundles; carrying the points and contracting once
/// keeps what single bundles are too sparse or too noisy to show. The curves stay the primitive to
/// which every bundle is registered.
class CarriedPoints {
 public:
  explicit CarriedPoints(const CarriedPointsOptions& options) : options_(options) {}

  /// Registers the ridges of a bundle (world frame), found with the options `ridges`, to those of
  /// the points carried so far and adds it; where wires are dense, most points lie between them and
  /// say nothing. The returned alignment is the identity for the first bundle and where too few
  /// points fit. `row_spacing` is that of AlignRows.
  AlignmentResult AddBundle(const ObservedPoints& bundle, const RidgePoints& found,
                            const RidgeProjectionOptions& ridges, const AlignmentOptions& alignment,
                            double row_spacing = 0);

  const ObservedPoints& points() const { return points_; }

  /// The ridges of the points, as found with the options of the last bundle.
  const RidgePoints& ridges() const { return ridges_; }

 private:
  CarriedPointsOptions options_;
  ObservedPoints points_;
  RidgePoints ridges_;
};

}  // namespace curvefusion
