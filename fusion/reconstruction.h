#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "capture/sequence.h"
#include "fusion/curve_graph/selection.h"
#include "fusion/funnel.h"
#include "fusion/silhouettes/view_evidence.h"
#include "fusion/stage_log.h"
#include "fusion/strips/radius.h"
#include "fusion/trust.h"
#include "fusion/volume/tsdf_volume.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// A stage that is to come, as PipelineObserver::OnProgress names it.
struct PlannedStage {
  std::string name;
  double cost = 0;  ///< expected seconds on the machine where costs were measured
};

/// Hears of a run while it goes on; every function does nothing by default. All are called from the
/// thread that called Reconstruct. An exception ends the run.
class PipelineObserver {
 public:
  virtual ~PipelineObserver() = default;
  /// All stages of the run in their order, before the first, and again whenever their costs are
  /// better known.
  virtual void OnPlan(const std::vector<PlannedStage>& /*stages*/) {}
  /// A stage is `done` of `total` steps far; it begins with done = 0.
  virtual void OnProgress(const std::string& /*stage*/, int64_t /*done*/, int64_t /*total*/) {}
  /// Intermediate point sets ("bundle_003_difference_set") in the world frame.
  virtual void OnPoints(const std::string& /*name*/, const ObservedPoints& /*points*/) {}
  /// Intermediate graphs ("bundle_003_skeleton", "bundle_003_fused") in the world frame.
  virtual void OnGraph(const std::string& /*name*/, const SkeletonGraph& /*graph*/) {}
  /// Tables of what is known of every stretch of candidate curves before any is dropped for it
  /// ("evidence"); `csv` gives the text.
  virtual void OnTable(const std::string& /*name*/, const std::function<std::string()>& /*csv*/) {}
  /// The volume once all frames are integrated.
  virtual void OnVolume(const TsdfVolume& /*volume*/) {}
};

/// What depth images were used for.
struct DepthAccount {
  std::string use;  ///< DepthRoleName; empty where it is not told
  std::string why;
};

/// The outcome of a run. An empty skeleton means: nothing thin was found, an expected outcome.
struct Reconstruction {
  /// The curves, world frame, with a radius (metres) at every point, or with none where no diameter
  /// could be measured in the whole scan. An edge whose radius in `radii.edges` is 0 was not
  /// measured and has `radii.unmeasured_radius`. Observations: how many images of `views` saw the
  /// point.
  SkeletonGraph skeleton;
  /// What may be thin but is no proven wire, world frame; the best profile only.
  UncertainCurves uncertain;
  ObservedPoints points;  ///< the points the skeleton was made from
  RadiusEstimate radii;   ///< may hold edges that the skeleton no longer has
  ViewEvidence views;     ///< of the skeleton
  /// The sequence with its poses corrected by the registration of frames and the adjustment to
  /// colours, which corrects the colour camera's principal point too (as given otherwise).
  Sequence sequence;
  std::vector<StageReport> stages;
  Funnel funnel;                      ///< what each rule took
  Trust trust;                        ///< how far the result may be trusted
  DepthAccount depth;                 ///< what depth was used for; the best profile only
  std::vector<std::string> warnings;  ///< what the user should know, a sentence each
};

}  // namespace curvefusion
