#pragma once

#include "capture/sequence.h"
#include "fusion/best/run_context.h"
#include "fusion/reconstruction.h"
#include "fusion/strips/radius.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The wires' radii in all colour images (CurveFusion 3.3, "Wire radius estimation"); the rows' own
/// where no strip can be measured for itself. Throws Error(kBadInput) for an image that cannot be
/// read.
RadiusEstimate MeasureRadii(const SkeletonGraph& skeleton, const Sequence& sequence,
                            RunContext& run);

/// What colour images tell of contracted curves: radii, wires that depth has missed, exact curves
/// and poses, which curves are false or missing, and where they were seen. `given` are the poses of
/// the input, which the adjustment's drift is counted from. Throws like MeasureRadii.
void RefineByColour(const Sequence& given, RunContext& run, Reconstruction& result);

}  // namespace curvefusion
