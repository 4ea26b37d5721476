#pragma once

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/best/best_plan.h"
#include "fusion/best/bundle_segmentation.h"
#include "fusion/reconstruction.h"
#include "fusion/stage_reporter.h"
#include "fusion/strips/radius.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What colour images tell of contracted curves: radii, wires that depth has missed, exact curves
/// and poses, which curves are false or missing, and where they were seen. `given` has the poses
/// that the adjustment's corrections are counted from, which err as told; `wires` what the
/// segmentation learned of close wires and of colours; `size` what the run has found, for its plan.
/// Throws like MeasureRadii.
void RefineByColour(const Sequence& given, PoseErrors pose_errors, const LearnedWires& wires,
                    RunSize size, const BestOptions& options, const StageReporter& reporter,
                    Reconstruction& result);

}  // namespace curvefusion
