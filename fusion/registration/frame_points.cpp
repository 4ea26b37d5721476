#include "fusion/registration/frame_points.h"

#include <utility>

namespace curvefusion {

namespace {

// Points `first`, `first` + `stride` and so on.
ObservedPoints EveryNth(const ObservedPoints& points, size_t stride, size_t first) {
  ObservedPoints kept;
  kept.Reserve(points.size() / stride + 1);
  for (size_t i = first; i < points.size(); i += stride) kept.Add(points, i);
  return kept;
}

}  // namespace

void FramePoints::Add(ObservedPoints frame) {
  // Not the same places of every frame, as all name them in the same order.
  if (stride_ > 1) frame = EveryNth(frame, stride_, frames_.size() % stride_);
  total_ += frame.size();
  frames_.push_back(std::move(frame));
  if (total_ <= max_points_) return;
  stride_ *= 2;
  total_ = 0;
  for (size_t i = 0; i < frames_.size(); ++i) {
    frames_[i] = EveryNth(frames_[i], 2, i % 2);
    total_ += frames_[i].size();
  }
}

}  // namespace curvefusion
