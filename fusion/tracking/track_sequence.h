#pragma once

#include <string>
#include <vector>

#include "capture/sequence.h"
#include "fusion/tracking/tracking_options.h"
#include "kernel/progress.h"

namespace curvefusion {

/// A frame whose pose could not be found.
struct LostFrame {
  std::string name;
  std::string why;  ///< a clause with figures
};

/// The camera's path as depth and colour tell it.
struct TrackingResult {
  Sequence sequence;  ///< the frames that were tracked, with their poses
  std::vector<LostFrame> lost;
  int keyframes = 0;
  /// What the user should know of lost frames, a sentence each; also in the sequence's warnings.
  std::vector<std::string> warnings;
};

/// As TrackSequence, but however many frames could be placed, and without warnings.
TrackingResult TrackFrames(const Sequence& images, const RigidTransform& T_world_start,
                           const TrackingOptions& options, const Progress& progress);

/// Finds the pose of every frame of a sequence, whatever poses it has; the first tracked one is at
/// `T_world_start`. Frames that cannot be placed are left out and named. Throws Error(kBadInput)
/// where fewer than half of the frames could be placed, and where an image cannot be read.
/// Exceptions of `progress` pass through. A frame of 640x480 takes a tenth of a second of processor
/// time.
TrackingResult TrackSequence(const Sequence& images, const RigidTransform& T_world_start,
                             const TrackingOptions& options, const Progress& progress);

}  // namespace curvefusion
