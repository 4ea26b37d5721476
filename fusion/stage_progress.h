#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "fusion/reconstruction.h"
#include "fusion/stage_log.h"

namespace curvefusion {

/// Where the stages of a run tell what they do. They only write to it: what one stage finds for
/// another goes from one to the other as a value.
struct StageReporter {
  PipelineObserver& observer;
  StageLog& log;

  /// Begins a stage of a single step. The time until the end of the result's life is the stage's.
  [[nodiscard]] StageLog::Timer Begin(const std::string& stage) const {
    observer.OnProgress(stage, 0, 1);
    return {log, stage};
  }
};

/// A stage that several threads work on: counts their steps and tells the observer of them from the
/// thread that made it, which is the one that called Reconstruct.
class StageProgress {
 public:
  /// Announces the stage.
  StageProgress(PipelineObserver& observer, std::string stage, int64_t total)
      : observer_(observer), stage_(std::move(stage)), total_(total) {
    observer_.OnProgress(stage_, 0, total_);
  }

  /// One step more is done. Any thread may call it; exceptions of the observer pass through.
  void Advance() {
    const int64_t done = ++done_;
    if (std::this_thread::get_id() == thread_) observer_.OnProgress(stage_, done, total_);
  }

 private:
  PipelineObserver& observer_;
  std::string stage_;
  int64_t total_;
  std::atomic<int64_t> done_{0};
  std::thread::id thread_ = std::this_thread::get_id();
};

}  // namespace curvefusion
