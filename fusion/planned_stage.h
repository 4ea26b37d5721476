#pragma once

#include <string>

namespace curvefusion {

/// A stage that is to come, as PipelineObserver::OnProgress names it.
struct PlannedStage {
  std::string name;
  double cost = 0;  ///< expected seconds on the machine where costs were measured
};

}  // namespace curvefusion
