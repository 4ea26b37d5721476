#pragma once

#include <string>
#include <vector>

#include "capture/content/depth_agreement.h"
#include "capture/trajectory.h"

namespace curvefusion {

/// Poses as they would be if one thing about them had been written wrongly.
struct PoseHypothesis {
  std::string cause;        ///< what CheckFinding::cause would be
  std::string description;  ///< of what is wrong, e.g. "the poses map world to camera"
  FramePoses poses;
};

/// The poses of a sequence as they were read.
FramePoses GivenPoses(const Sequence& sequence);

/// The same pose for every frame: what a camera would have that stands still.
FramePoses StandingPoses(size_t frame_count);

/// World to camera instead of camera to world; quaternions with w first; OpenGL's camera, which
/// looks along -z with y up.
std::vector<PoseHypothesis> ConventionHypotheses(const FramePoses& poses);

/// Poses in the reverse order of the frames, or in that of their numbers as text (0, 1, 10, 11, 2);
/// or the frames in that order, and the poses not.
std::vector<PoseHypothesis> OrderHypotheses(const FramePoses& poses);

/// Translations times a factor.
FramePoses ScaledTranslations(const FramePoses& poses, double factor);

/// Every frame with the pose of the frame `frames` later.
FramePoses DelayedPoses(const FramePoses& poses, int frames);

/// Poses at times, each `offset` seconds later in the trajectory, between neighbours that are at
/// most 0.2 s apart, or 1.5 times the trajectory's step where that is more.
FramePoses PosesAt(const Trajectory& trajectory, const std::vector<double>& times, double offset);

/// The order of the numbers 0 .. count-1 as text, each increased by `first`.
std::vector<int> OrderAsText(int count, int first);

}  // namespace curvefusion
