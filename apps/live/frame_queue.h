#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

#include "apps/live/live_source.h"

namespace curvefusion {

/// Frames that wait for the thread that works on them, at most so many: who adds them never waits.
/// Of a full queue the frame goes whose neighbours are closest in time, so that what remains is
/// spread evenly and the camera moves little from one frame to the next, however far the work
/// falls behind.
class FrameQueue {
 public:
  /// `capacity` is at least 1.
  explicit FrameQueue(size_t capacity) : capacity_(capacity) {}

  /// Adds a frame, later than those before. Returns whether one was dropped for it.
  bool Push(ArrivedFrame frame);

  /// Takes the earliest frame, waits where there is none; nothing once the queue is closed and
  /// empty.
  std::optional<ArrivedFrame> Pop();

  /// No more frames will come.
  void Close();

 private:
  void DropOne();

  size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ArrivedFrame> frames_;
  double last_taken_ = 0;  ///< arrival of the frame that was popped last
  bool closed_ = false;
};

}  // namespace curvefusion
