#pragma once

#include "fusion/best/best_options.h"
#include "fusion/best/bundle_segmentation.h"
#include "fusion/reconstruction.h"
#include "fusion/stage_progress.h"

namespace curvefusion {

/// Deviation: adds the wires of nets, drops what the wires themselves hide, takes apart what does
/// not touch, and makes junctions of what does.
void FinishCurves(const LearnedWires& wires, const BestOptions& options,
                  const StageReporter& reporter, Reconstruction& result);

}  // namespace curvefusion
