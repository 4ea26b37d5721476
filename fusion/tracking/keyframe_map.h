#pragma once

#include <vector>

#include "fusion/tracking/photometric_term.h"

namespace curvefusion {

/// The keyframes of a run. Frames are compared with the one nearest to them, however old: a camera
/// that comes back finds its first pose again instead of adding up errors.
class KeyframeMap {
 public:
  struct Entry {
    Keyframe keyframe;
    FrameLevel coarsest;
  };

  /// The keyframe that looks most nearly where a camera at this pose looks; null where there is
  /// none that shares most of its view.
  const Entry* Nearest(const RigidTransform& T_world_camera) const;

  /// Those whose coarsest grey image is most like this one (normalised cross-correlation), at most
  /// `count`, the likest first.
  std::vector<const Entry*> MostAlike(const FrameLevel& coarsest, int count) const;

  /// Adds a frame where none of the keyframes is near.
  void AddIfNew(const TrackingFrame& frame, const RigidTransform& T_world_camera,
                const RigidTransform& T_color_depth);

  int size() const { return static_cast<int>(entries_.size()); }

 private:
  std::vector<Entry> entries_;
};

}  // namespace curvefusion
