#pragma once

#include <functional>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/best/best_plan.h"
#include "fusion/best/bundle_segmentation.h"
#include "fusion/reconstruction.h"
#include "fusion/stage_progress.h"

namespace curvefusion {

/// A scan and its poses.
struct PosedScan {
  const Sequence& given;                   ///< as they came
  Sequence sequence;                       ///< as curves are looked for with
  PoseErrors errors = PoseErrors::kDrift;  ///< how those err
  /// Holds them to surfaces, which takes long; empty where they are held, or better as they are.
  std::function<Sequence()> hold = {};
};

/// What colour images tell of contracted curves: radii, wires that depth has missed, exact curves
/// and poses, which curves are false or missing, and where they were seen. Corrections of poses are
/// counted from those of `scan.sequence`; curves from colour alone are looked for with held ones.
/// `wires` is what the segmentation learned of close wires and of colours; `size` what the run has
/// found, for its plan. Throws like MeasureRadii.
void RefineByColour(const PosedScan& scan, const LearnedWires& wires, RunSize size,
                    const BestOptions& options, const StageReporter& reporter,
                    Reconstruction& result);

}  // namespace curvefusion
