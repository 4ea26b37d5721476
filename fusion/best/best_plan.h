#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/planned_stage.h"

namespace curvefusion {

/// What a run has found so far; 0 = not yet known.
struct RunSize {
  double points = 0;  ///< of all bundles
  double length = 0;  ///< metres of curve
};

/// The stages of ReconstructBest in their order and what they cost for a scan of this many frames
/// and pixels, as far as the size of what is found is known.
std::vector<PlannedStage> PlanBest(const Sequence& sequence, const BestOptions& options,
                                   const RunSize& size);

}  // namespace curvefusion
