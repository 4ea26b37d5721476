#pragma once

#include <vector>

#include "fusion/registration/alignment.h"
#include "fusion/registration/drift_smoothing.h"
#include "graph/contraction/ridge_projection.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// How single frames are registered to the curves.
struct FrameRegistrationOptions {
  int rounds = 1;
  double reach = 0.006;
  DriftOptions drift;
};
void VisitOptions(FrameRegistrationOptions& options, OptionVisitor& visitor);

/// Frames registered to one another through the curves they all saw.
struct RegisteredFrames {
  ObservedPoints points;                           ///< of all frames, resampled on a grid
  std::vector<RigidTransform> T_registered_world;  ///< one per frame: how its pose was corrected
  int registered = 0;                              ///< frames that found enough curves
};

/// Registers every frame to the ridges of all frames' points, merges the moved points, and repeats.
/// `ridge` holds the ridges of all frames' points, with the start corrections, found with the
/// options `ridges`; they are followed as the points move. `frames` holds what each frame saw
/// (world frame, by its given pose, one entry per frame in order of time), `start` a first
/// correction for each, `cameras` where each was taken from. What single frames measure is smoothed
/// over time by what is known of drift: a frame alone is too noisy. In the end everything is moved
/// so that the first frame keeps its given pose: the drift of a trajectory starts at zero there.
/// Deviation: the paper registers whole bundles, which are smeared by the drift within them and tie
/// the world to the mean drift of the first one.
RegisteredFrames RegisterFrames(const std::vector<ObservedPoints>& frames,
                                const std::vector<RigidTransform>& start,
                                const std::vector<Vec3>& cameras, RidgePoints ridge,
                                const RidgeProjectionOptions& ridges,
                                const AlignmentOptions& alignment,
                                const FrameRegistrationOptions& options);

}  // namespace curvefusion
