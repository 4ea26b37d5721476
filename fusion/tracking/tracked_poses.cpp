#include "fusion/tracking/tracked_poses.h"

#include <algorithm>

#include "capture/content/geometry_check.h"
#include "capture/detect_format.h"
#include "kernel/error.h"

namespace curvefusion {

RigidTransform GivenStart(const Sequence& images) {
  const Sequence given =
      ReadSequence(images.folder, PoseUse::kIfGiven, DepthUse::kNeeded, [](const CheckFinding&) {});
  if (!given.has_poses || images.frames.empty()) return RigidTransform::Identity();
  const std::string& first = images.frames.front().name;
  const auto frame = std::find_if(given.frames.begin(), given.frames.end(),
                                  [&](const SequenceFrame& f) { return f.name == first; });
  return frame == given.frames.end() ? RigidTransform::Identity() : frame->T_world_camera;
}

Trajectory PosesOf(const Sequence& sequence) {
  Trajectory trajectory;
  for (const SequenceFrame& frame : sequence.frames) {
    trajectory.push_back({frame.timestamp, frame.T_world_camera});
  }
  return trajectory;
}

std::string DoubtOfPoses(const Sequence& tracked) {
  if (!DepthDisagrees(tracked)) return {};
  return tracked.folder.string() +
         ": the tracked poses do not fit the depth images: the camera was lost without notice; "
         "scan "
         "more slowly and nearer to things with corners and colours, or give poses of another "
         "system (docs/tracking.md)";
}

std::optional<Sequence> HeldToItsSurfaces(const Sequence& given, const Progress& progress) {
  const TrackingResult tracking =
      TrackFrames(given, given.frames.front().T_world_camera, {}, progress);
  if (!tracking.lost.empty() || DepthDisagrees(tracking.sequence)) return std::nullopt;
  return tracking.sequence;
}

std::optional<TrackingResult> FindPoses(Sequence& sequence, const Progress& progress) {
  if (sequence.has_poses) {
    if (sequence.has_depth) RequireFittingPoses(sequence);
    return std::nullopt;
  }
  if (!sequence.has_depth) {
    throw Error(
        ErrorKind::kBadInput,
        sequence.folder.string() + ": has no poses, and they can be tracked by depth images only");
  }
  TrackingResult tracking = TrackSequence(sequence, GivenStart(sequence), {}, progress);
  sequence = tracking.sequence;
  const std::string doubt = DoubtOfPoses(sequence);
  if (!doubt.empty()) throw Error(ErrorKind::kBadInput, doubt);
  return tracking;
}

}  // namespace curvefusion
