#pragma once

#include <vector>

#include "fusion/alignment.h"
#include "graph/ridge_projection.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// How single frames are registered to the curves.
struct FrameRegistrationOptions {
  int rounds = 2;
  double min_inliers = 0.5;
  int min_points = 100;
  double voxel_size = 0.0025;
};
void VisitOptions(FrameRegistrationOptions& options, OptionVisitor& visitor);

/// Frames registered to one another through the curves they all saw.
struct RegisteredFrames {
  ObservedPoints points;                           ///< of all frames, resampled on a grid
  std::vector<RigidTransform> T_registered_world;  ///< one per frame: how its pose was corrected
  int registered = 0;                              ///< frames that found enough curves
};

/// Registers every frame to the ridges of all frames' points, merges the moved points, and repeats.
/// `frames` holds what each frame saw (world frame, by its given pose, one entry per frame in order
/// of time), `start` a first correction for each. Frames that see too little keep the correction of
/// their neighbour in time. In the end everything is moved so that the first frame that was
/// registered keeps its given pose: the drift of a trajectory starts at zero there.
/// Deviation: the paper registers bundles as a whole; a bundle smears by the drift within it, and
/// anchors the world to the mean drift of the first one.
RegisteredFrames RegisterFrames(const std::vector<ObservedPoints>& frames,
                                const std::vector<RigidTransform>& start,
                                const RidgeProjectionOptions& ridges,
                                const AlignmentOptions& alignment,
                                const FrameRegistrationOptions& options);

}  // namespace curvefusion
