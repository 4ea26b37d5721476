#include "apps/live/frame_queue.h"

#include <cassert>
#include <cstddef>
#include <utility>

namespace curvefusion {

bool FrameQueue::Push(ArrivedFrame frame) {
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    assert(!closed_);
    frames_.push_back(std::move(frame));
    full = frames_.size() > capacity_;
    if (full) DropOne();
  }
  changed_.notify_one();
  return full;
}

// The last one has no later neighbour yet, so it stays.
void FrameQueue::DropOne() {
  size_t dropped = 0;
  double least_span = 0;
  for (size_t i = 0; i + 1 < frames_.size(); ++i) {
    const double before = i == 0 ? last_taken_ : frames_[i - 1].arrival;
    const double span = frames_[i + 1].arrival - before;
    if (i > 0 && span >= least_span) continue;
    dropped = i;
    least_span = span;
  }
  frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(dropped));
}

std::optional<ArrivedFrame> FrameQueue::Pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return closed_ || !frames_.empty(); });
  if (frames_.empty()) return std::nullopt;
  ArrivedFrame next = std::move(frames_.front());
  frames_.pop_front();
  last_taken_ = next.arrival;
  return next;
}

void FrameQueue::Close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_one();
}

}  // namespace curvefusion
