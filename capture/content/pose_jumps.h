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
  double usual_difference = 0;  ///< likewise, between other neighbours, median
};

/// Looks at every pair of neighbouring frames. A jump is a change of motion at least five times
/// that of its surroundings which the depth of both frames contradicts, and more so than a steady
/// motion; or, where frames are far apart and no motion is steady, a place across which depth
/// disagrees while it agrees on both sides. About .2 ms a frame.
std::vector<PoseJump> FindPoseJumps(const DepthViews& views, const FramePoses& poses);

/// Frames around which depth disagrees much more than elsewhere.
struct BadStretch {
  int first = 0;
  int last = 0;
  double residual = 0;    ///< relative to distance, median
  double difference = 0;  ///< metres, median
};

/// Stretches of at least five frames, each of which disagrees with most of the good frames five and
/// ten before and after it, by more than 2.5 % of the distance and five times what is typical.
/// Frames on two sides of a jump are not compared.
std::vector<BadStretch> FindBadStretches(const DepthViews& views, const FramePoses& poses,
                                         const std::vector<PoseJump>& jumps);

}  // namespace curvefusion
