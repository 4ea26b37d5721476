#pragma once

#include "fusion/best/best_options.h"
#include "fusion/best/best_plan.h"
#include "fusion/funnel.h"
#include "fusion/reconstruction.h"
#include "fusion/segmentation/colour_gate.h"
#include "fusion/stage_log.h"

namespace curvefusion {

/// What the steps of one run share: options, where they report to, and what is known of close
/// wires.
struct RunContext {
  const BestOptions& options;
  PipelineObserver& observer;
  StageLog log;
  Funnel funnel = {};
  RunSize size = {};
  double row_spacing = 0;    ///< of close wires, metres; 0 where there are none
  double row_diameter = 0;   ///< of theirs, metres, roughly
  WireColours colours;       ///< of wires and background, as first learned
  double magnification = 1;  ///< of points, for them
  double ray_noise_ratio = 1;
};

}  // namespace curvefusion
