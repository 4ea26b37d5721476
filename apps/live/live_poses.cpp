#include "apps/live/live_poses.h"

namespace curvefusion {

namespace {

TrackingCameras CamerasOf(const Sequence& sequence) {
  return {sequence.depth_camera, sequence.color_camera, sequence.T_color_depth};
}

}  // namespace

LivePoses::LivePoses(const Sequence& cameras) : single_(cameras) {
  single_.frames.clear();
  if (!cameras.has_poses) {
    tracker_.emplace(CamerasOf(cameras), TrackingOptions(), RigidTransform::Identity());
  }
}

bool LivePoses::Place(SequenceFrame& frame) {
  if (!tracker_) return true;
  single_.frames = {frame};
  TrackingFrame levels =
      MakeTrackingFrame(LoadDepth(single_, 0), LoadColor(single_, 0), CamerasOf(single_), {});
  levels.timestamp = frame.timestamp;
  levels.color_delay = frame.color_delay;
  const TrackedFrame tracked = tracker_->Track(levels);
  frame.T_world_camera = tracked.T_world_camera;
  return tracked.is_tracked;
}

}  // namespace curvefusion
