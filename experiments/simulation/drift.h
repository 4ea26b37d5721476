#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// How the poses of a tracker err, per axis: an Ornstein-Uhlenbeck drift, a random walk and a quick
/// jitter. Metres, radians, seconds.
struct PoseErrorModel {
  double drift_memory = 1;
  double drift_translation = 0;
  double drift_rotation = 0;
  double walk_translation = 0;  ///< per square root of a second
  double walk_rotation = 0;
  double jitter_memory = 1;
  double jitter_translation = 0;
  double jitter_rotation = 0;
};

/// `true`, `orbslam2`, `bundlefusion`, `kinfu`, `kitchen`, `ptam`.
std::vector<std::string> PoseSourceNames();

/// The errors of a tracker of that name, fitted to published accuracies of such systems on
/// hand-held scans; those of `kitchen` to a real recording, in which depth 30 frames apart
/// disagrees by 4, 6, 8 and 13 mm at .8, 1.2, 1.6 and 2.5 m. Sigmas times `scale`. Throws
/// Error(kUsage) for another name.
PoseErrorModel PoseErrorOf(const std::string& source, double scale = 1);

/// True poses, each moved (from the right: in the camera's frame) by the model's error. The error
/// of the first frame is 0, so both trajectories start alike.
std::vector<RigidTransform> DriftedPoses(const std::vector<RigidTransform>& true_poses,
                                         double frame_rate, const PoseErrorModel& model,
                                         uint64_t seed);

}  // namespace curvefusion
