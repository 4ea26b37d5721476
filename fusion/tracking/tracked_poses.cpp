#include "fusion/tracking/tracked_poses.h"

#include <algorithm>
#include <utility>

#include "capture/content/geometry_check.h"
#include "capture/detect_format.h"
#include "capture/frame_stream.h"
#include "fusion/tracking/camera_tracker.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

// Pixels. Chosen: with 320 poses are no better, with 160 worse (docs/tracking.md).
constexpr int kHeldImageWidth = 213;

}  // namespace

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

Sequence HeldToItsSurfaces(const Sequence& given, const std::vector<int>& frames,
                           const Progress& progress) {
  Sequence held = given;
  if (frames.empty()) return held;
  const TrackingCameras cameras = CamerasOf(given);
  TrackingOptions options;
  options.image_width = kHeldImageWidth;
  options.use_color = false;                          // colour cameras lie some pixels beside depth
  auto before = static_cast<size_t>(frames.front());  // the frame tracked last
  CameraTracker tracker(cameras, options, given.frames[before].T_world_camera);
  int64_t done = 0;
  ForEachFrame(given, frames, {.depth = true, .color = false}, [&](const DecodedFrame& decoded) {
    const auto i = static_cast<size_t>(decoded.index);
    const RigidTransform T_before_now =
        given.frames[before].T_world_camera.inverse() * given.frames[i].T_world_camera;
    const TrackedFrame tracked = tracker.TrackNear(
        MakeTrackingFrame(given.frames[i], decoded.depth, {}, cameras, options), T_before_now);
    held.frames[i].T_world_camera = tracked.is_tracked
                                        ? tracked.T_world_camera
                                        : held.frames[before].T_world_camera * T_before_now;
    if (tracked.is_tracked) before = i;
    progress("hold to surfaces", ++done, static_cast<int64_t>(frames.size()));
  });
  return held;
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
