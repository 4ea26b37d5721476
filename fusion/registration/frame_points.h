#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "kernel/observed_points.h"

namespace curvefusion {

/// What each frame saw of the points, until frames are registered one by one; in memory that does
/// not grow with their number. Where all frames together saw more than `max_points`, every second
/// point of each is left out, of those that come later too, and again where they are still too
/// many: frames are registered to curves by some hundred points, and places that were seen so often
/// need not all sightings.
class FramePoints {
 public:
  explicit FramePoints(size_t max_points) : max_points_(max_points) {}

  /// Adds the next frame's points, which may be none.
  void Add(ObservedPoints frame);

  /// One entry per frame, in the order in which they were added.
  std::vector<ObservedPoints> Release() && { return std::move(frames_); }

  /// Of every so many points of a frame one is kept.
  size_t stride() const { return stride_; }

 private:
  size_t max_points_;
  size_t stride_ = 1;
  size_t total_ = 0;
  std::vector<ObservedPoints> frames_;
};

}  // namespace curvefusion
