#include "fusion/tracking/track_sequence.h"

#include <fmt/format.h>

#include "capture/frame_stream.h"
#include "fusion/tracking/camera_tracker.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr const char* kStage = "track camera";
constexpr size_t kNamedFrames = 3;   // chosen: a message stays short
constexpr double kMinTracked = 0.5;  // chosen: of less, what was scanned is guesswork
constexpr const char* kRemedy =
    "move the camera slower, keep it within 4 m of furniture or a textured background, or give "
    "poses of another tracker";

std::string NameSome(const std::vector<LostFrame>& lost) {
  std::string names;
  for (size_t i = 0; i < std::min(lost.size(), kNamedFrames); ++i) {
    names += fmt::format("{}{} ({})", i == 0 ? "" : ", ", lost[i].name, lost[i].why);
  }
  if (lost.size() > kNamedFrames) names += fmt::format(" and {} more", lost.size() - kNamedFrames);
  return names;
}

std::string Counts(const Sequence& images, const TrackingResult& result) {
  return fmt::format("{}: the camera could not be tracked in {} of {} frames: {}",
                     images.folder.string(), result.lost.size(), images.frame_count(),
                     NameSome(result.lost));
}

void RequireMostTracked(const Sequence& images, const TrackingResult& result) {
  if (result.sequence.frame_count() >= kMinTracked * images.frame_count()) return;
  throw Error(ErrorKind::kBadInput, fmt::format("{}; {}", Counts(images, result), kRemedy));
}

void Warn(const Sequence& images, TrackingResult& result) {
  if (result.lost.empty()) return;
  const bool to_the_end = result.lost.back().name == images.frames.back().name;
  result.warnings.push_back(
      fmt::format("{}; {}they are left out", Counts(images, result),
                  to_the_end ? "it was not found again before the end, " : ""));
}

}  // namespace

TrackingResult TrackFrames(const Sequence& images, const RigidTransform& T_world_start,
                           const TrackingOptions& options, const Progress& progress) {
  const TrackingCameras cameras = CamerasOf(images);
  CameraTracker tracker(cameras, options, T_world_start);
  TrackingResult result;
  result.sequence = images;
  result.sequence.has_poses = true;
  result.sequence.frames.clear();
  const FrameStreamOptions stream = {true, options.use_color};
  progress(kStage, 0, images.frame_count());
  ForEachFrame(images, 0, images.frame_count(), stream, [&](const DecodedFrame& decoded) {
    SequenceFrame entry = images.frames[static_cast<size_t>(decoded.index)];
    const TrackedFrame tracked =
        tracker.Track(MakeTrackingFrame(entry, decoded.depth, decoded.color, cameras, options));
    if (tracked.is_tracked) {
      entry.T_world_camera = tracked.T_world_camera;
      result.sequence.frames.push_back(std::move(entry));
    } else {
      result.lost.push_back({entry.name, tracked.why_lost});
    }
    progress(kStage, decoded.index + 1, images.frame_count());
  });
  result.keyframes = tracker.keyframe_count();
  return result;
}

TrackingResult TrackSequence(const Sequence& images, const RigidTransform& T_world_start,
                             const TrackingOptions& options, const Progress& progress) {
  TrackingResult result = TrackFrames(images, T_world_start, options, progress);
  RequireMostTracked(images, result);
  Warn(images, result);
  for (const std::string& warning : result.warnings) result.sequence.warnings.push_back(warning);
  return result;
}

}  // namespace curvefusion
