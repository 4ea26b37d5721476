#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/sequence.h"
#include "fusion/adjustment/colour_adjustment.h"
#include "fusion/funnel.h"
#include "fusion/registration/alignment.h"
#include "fusion/registration/carried_points.h"
#include "fusion/registration/frame_registration.h"
#include "fusion/registration/skeleton_fusion.h"
#include "fusion/run_plan.h"
#include "fusion/segmentation/segmentation.h"
#include "fusion/silhouettes/silhouette_topology.h"
#include "fusion/silhouettes/view_evidence.h"
#include "fusion/silhouettes/wire_completion.h"
#include "fusion/stage_log.h"
#include "fusion/strips/radius.h"
#include "fusion/trust.h"
#include "fusion/volume/tsdf_volume.h"
#include "graph/l1_contraction.h"
#include "graph/ridge_skeleton.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// The paper as it is written, or what a user gets by default.
enum class Profile { kPaper, kBest };

/// The options of every stage.
struct PipelineOptions {
  TsdfOptions volume;
  int volume_stride = 1;
  SegmentationOptions segmentation;
  bool carry_points = false;
  CarriedPointsOptions carried;
  AlignmentOptions registration;
  FrameRegistrationOptions frames;
  double axis_depth = 0;
  double min_linearity = 0.3;
  double resolved_spacing = 0;
  RidgeOptions ridge;
  L1Options l1;
  SkeletonFusionOptions fusion;
  RadiusOptions radius;
  WireCompletionOptions completion;
  ColourAdjustmentOptions colour_adjustment;
  SilhouetteOptions silhouettes;
  ViewEvidenceOptions evidence;
};

/// The options a profile starts from, before the config file and --set.
PipelineOptions ProfileOptions(Profile profile);

/// Visits every option, each stage in a section of its own.
void VisitOptions(PipelineOptions& options, OptionVisitor& visitor);

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
  /// The volume once all frames are integrated.
  virtual void OnVolume(const TsdfVolume& /*volume*/) {}
};

/// The outcome of a run. An empty skeleton means: nothing thin was found, an expected outcome.
struct Reconstruction {
  /// Radii at every vertex where any could be measured. Observations: in the paper profile bundles,
  /// otherwise images of `views` that saw the point.
  SkeletonGraph skeleton;
  ObservedPoints points;  ///< the points the skeleton was made from
  RadiusEstimate radii;   ///< may hold edges that the skeleton no longer has
  ViewEvidence views;     ///< of the skeleton
  /// The sequence with its poses corrected by the registration of frames and the adjustment to
  /// colours, which corrects the colour camera's principal point too (as given otherwise).
  Sequence sequence;
  std::vector<StageReport> stages;
  Funnel funnel;                      ///< what each rule took
  Trust trust;                        ///< how far the result may be trusted
  std::vector<std::string> warnings;  ///< what the user should know, a sentence each
};

/// The whole method, CurveFusion section 3. Throws Error for input that cannot be read.
Reconstruction Reconstruct(const Sequence& sequence, const PipelineOptions& options,
                           PipelineObserver& observer);

/// The rest of the method where the large surfaces are known already: `volume` holds them in the
/// sequence's world frame and may have seen more frames than the sequence has.
Reconstruction ReconstructAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                  const PipelineOptions& options, PipelineObserver& observer);

}  // namespace curvefusion
