#pragma once

#include <string>
#include <vector>

#include "capture/sequence.h"

namespace curvefusion {

struct PipelineOptions;

/// A stage that is to come, as PipelineObserver::OnProgress names it.
struct PlannedStage {
  std::string name;
  double cost = 0;  ///< expected seconds on the machine where costs were measured
};

/// What a run has found so far; 0 = not yet known.
struct RunSize {
  double points = 0;  ///< of all bundles
  double length = 0;  ///< metres of curve
};

/// The stages of Reconstruct in their order and what they cost for a scan of this many frames and
/// pixels, as far as the size of what is found is known.
std::vector<PlannedStage> PlanRun(const Sequence& sequence, const PipelineOptions& options,
                                  const RunSize& size);

}  // namespace curvefusion
