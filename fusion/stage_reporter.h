#pragma once

#include <string>

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

}  // namespace curvefusion
