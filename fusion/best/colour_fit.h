#pragma once

#include <optional>

#include "capture/sequence.h"
#include "fusion/adjustment/colour_adjustment.h"
#include "fusion/curve_graph/selection.h"
#include "fusion/reconstruction.h"
#include "fusion/silhouettes/view_evidence.h"
#include "fusion/stage_progress.h"
#include "fusion/strips/radius.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The wires' radii in all colour images (CurveFusion 4.3, "Wire radius estimation"); those of
/// close wires (`array_diameter`, metres) where no strip can be measured for itself. Throws
/// Error(kBadInput) for an image that cannot be read.
RadiusEstimate MeasureRadii(const SkeletonGraph& skeleton, const Sequence& sequence,
                            double array_diameter, const RadiusOptions& options,
                            const StageReporter& reporter);

/// Measures the radii of the result's curves and sets them. Throws like MeasureRadii.
void AssignMeasuredRadii(double array_diameter, const RadiusOptions& options,
                         const StageReporter& reporter, Reconstruction& result);

/// Deviation: curves of known radius and poses of the result as exact as the colour images show
/// them. Nothing where nothing was changed. Throws like MeasureRadii.
std::optional<ColourAdjustment> AdjustCurvesAndPoses(const AdjustmentStart& start,
                                                     const ColourAdjustmentOptions& options,
                                                     const StageReporter& reporter,
                                                     Reconstruction& result);

/// The least probabilities of curves that were adjusted to colours.
ProofLimits LimitsOf(const ViewEvidenceOptions& options);

}  // namespace curvefusion
