#pragma once

#include <optional>

#include "capture/sequence.h"
#include "fusion/tracking/camera_tracker.h"

namespace curvefusion {

/// Gives frames their poses where the source gives none: by tracking the camera.
class LivePoses {
 public:
  explicit LivePoses(const Sequence& cameras);

  /// Sets the frame's pose, unless it has one. False where the camera was lost. A frame of 640x480
  /// takes a tenth of a second of processor time. Throws Error(kBadInput) for an image that cannot
  /// be read.
  bool Place(SequenceFrame& frame);

 private:
  Sequence single_;  ///< the frame that is placed
  std::optional<CameraTracker> tracker_;
};

}  // namespace curvefusion
