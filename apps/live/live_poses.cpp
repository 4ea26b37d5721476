#include "apps/live/live_poses.h"

namespace curvefusion {

LivePoses::LivePoses(const Sequence& cameras) : single_(cameras) {
  single_.frames.clear();
  if (!cameras.has_poses) {
    tracker_.emplace(CamerasOf(cameras), TrackingOptions(), RigidTransform::Identity());
  }
}

bool LivePoses::Place(SequenceFrame& frame) {
  if (!tracker_) return true;
  single_.frames = {frame};
  const TrackedFrame tracked = tracker_->Track(MakeTrackingFrame(
      frame, LoadDepth(single_, 0), LoadColor(single_, 0), CamerasOf(single_), {}));
  frame.T_world_camera = tracked.T_world_camera;
  return tracked.is_tracked;
}

}  // namespace curvefusion
