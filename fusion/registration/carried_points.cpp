#include "fusion/registration/carried_points.h"

#include <algorithm>

#include "fusion/registration/close_wires.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// Chosen: bundles are few, what a limit on iterations saves for single frames is nothing here.
constexpr int kIterations = 40;

}  // namespace

void VisitOptions(CarriedPointsOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"carried_voxel_size", "m", 0.0005, 0.05,
                 "Deviation: grid on which the points of all bundles are merged."},
                options.voxel_size);
  visitor.Visit(
      {"min_inliers", "", 0, 1,
       "Deviation: a bundle of which a smaller share fits the curves so far keeps its pose."},
      options.min_inliers);
}

AlignmentResult CarriedPoints::AddBundle(const ObservedPoints& bundle, const RidgePoints& found,
                                         double spacing, const AlignmentOptions& alignment,
                                         double array_spacing) {
  AlignmentResult result;
  if (!points_.empty() && !bundle.empty()) {
    AlignmentOptions patient = alignment;
    patient.max_iterations = std::max(alignment.max_iterations, kIterations);
    result = AlignArrays(found, AlignmentTarget({ridges_.positions, ridges_.directions}), patient,
                         array_spacing);
    if (!result.converged || result.inlier_fraction < options_.min_inliers) {
      result.T_target_source = RigidTransform::Identity();
    }
  }
  Append(points_, Transformed(bundle, result.T_target_source));
  points_ = ResampleOnGrid(points_, options_.voxel_size);
  ridges_ = Merged(ridges_, Transformed(found, result.T_target_source), spacing);
  return result;
}

}  // namespace curvefusion
