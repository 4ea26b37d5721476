#pragma once

#include <vector>

#include "capture/content/depth_agreement.h"

namespace curvefusion {

/// A place where a trajectory leaps and the images do not.
struct PoseJump {
  int frame = 0;                 ///< the leap is from here to the next frame
  double translation = 0;        ///< metres
  double rotation = 0;           ///< radians
  double difference = 0;         ///< metres, of depth across the leap as given
  double smooth_difference = 0;  ///< likewise, if the camera had moved on as before or after
};

/// Looks at every pair of neighbouring frames: a jump is a change of motion at least five times
/// that of its surroundings which the depth of both frames contradicts, and more so than a steady
/// motion. Views that are no video have none. About .2 ms a frame.
std::vector<PoseJump> FindPoseJumps(const DepthViews& views, const FramePoses& poses);

/// Frames around which depth disagrees much more than elsewhere.
struct BadStretch {
  int first = 0;
  int last = 0;
  double residual = 0;    ///< relative to distance, median
  double difference = 0;  ///< metres, median
};

/// Stretches of at least five frames whose depth disagrees with that of frames ten later by more
/// than 2.5 % of the distance and five times the median of the scan; frames next to a jump left
/// out.
std::vector<BadStretch> FindBadStretches(const DepthViews& views, const FramePoses& poses,
                                         const std::vector<PoseJump>& jumps);

}  // namespace curvefusion
