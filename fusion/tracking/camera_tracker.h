#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusion/tracking/frame_alignment.h"
#include "fusion/tracking/keyframe_map.h"
#include "fusion/tracking/tracking_options.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

/// What became of a frame.
struct TrackedFrame {
  bool is_tracked = false;
  RigidTransform T_world_camera = RigidTransform::Identity();  ///< where it is tracked
  std::string why_lost;      ///< a clause with figures, where it is not
  FrameAlignment alignment;  ///< of the last attempt
};

/// Finds the pose of frame after frame against a volume of those before (KinectFusion, Newcombe et
/// al. 2011) and against keyframes, and adds the frame to both. A frame that cannot be placed
/// changes nothing; the next ones are tried from where the camera was last and from the keyframes
/// that look alike. The same frames give the same poses for any number of threads.
class CameraTracker {
 public:
  /// The first frame is at `T_world_start`. Throws Error(kUsage) for options out of range.
  CameraTracker(const TrackingCameras& cameras, const TrackingOptions& options,
                const RigidTransform& T_world_start);

  /// `frame` comes from MakeTrackingFrame with the same cameras and options; later than the ones
  /// before. Throws Error(kResource) where the volume grows beyond its memory.
  TrackedFrame Track(const TrackingFrame& frame);

  /// Likewise from the motion since the frame tracked last, as another tracker gives it: what
  /// surfaces and colours do not tell stays as it is. A frame that cannot be placed is not added.
  TrackedFrame TrackNear(const TrackingFrame& frame, const RigidTransform& T_before_now);

  int keyframe_count() const { return keyframes_.size(); }

 private:
  /// The frame tracked last.
  struct Before {
    EarlierPose pose;
    RigidTransform velocity = RigidTransform::Identity();  ///< motion over `interval`
    double interval = 0;
    FrameLevel coarsest;
  };

  TrackedFrame Start(const TrackingFrame& frame);
  std::vector<RigidTransform> Guesses(const TrackingFrame& frame) const;
  TrackedFrame TryFrom(const TrackingFrame& frame,
                       const std::vector<RigidTransform>& T_world_guesses,
                       const PosePrior* prior = nullptr) const;
  TrackedFrame TryFromKeyframes(const TrackingFrame& frame) const;
  void Add(const TrackingFrame& frame, const RigidTransform& T_world_camera);

  TrackingCameras cameras_;
  RigidTransform T_world_start_;
  TsdfVolume volume_;
  KeyframeMap keyframes_;
  std::optional<Before> before_;
  bool was_lost_ = false;
};

/// Why an alignment is not to be trusted, a clause with figures; empty where it is. Where the
/// motion is given, surfaces need not hold the camera, and less of them does.
std::string WhyNotTrusted(const FrameAlignment& alignment, bool motion_is_given = false);

}  // namespace curvefusion
