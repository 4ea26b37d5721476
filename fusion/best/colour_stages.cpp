#include "fusion/best/colour_stages.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/curve_graph/candidate_curves.h"
#include "fusion/curve_graph/colour_candidates.h"
#include "fusion/curve_graph/selection.h"
#include "fusion/curve_graph/strip_views.h"
#include "fusion/curve_graph/tip_tracking.h"
#include "fusion/curve_graph/wire_proof.h"
#include "fusion/silhouettes/colour_pruning.h"
#include "fusion/silhouettes/weak_wires.h"
#include "graph/parallel_edges.h"

namespace curvefusion {

namespace {

constexpr const char* kImagesDoNotTell =
    "skipped: the images do not show the curves as wire throughout";
// Chosen: before poses and curves are adjusted to colours more is given the benefit of the doubt.
constexpr double kHardlyAWire = 0.4;  // times evidence.min_probability

void AssignMeasuredRadii(double row_diameter, const RadiusOptions& options,
                         const StageReporter& reporter, Reconstruction& result) {
  result.radii = MeasureRadii(result.skeleton, result.sequence, row_diameter, options, reporter);
  AssignRadii(result.radii, result.skeleton);
}

// Thin by proof: what is a wire with less than `min_probability` leaves the result. Radii come
// before. Whether any wire left: then edges were cut, and radii are to be measured again.
bool KeepProvenWires(const std::string& name, double min_probability,
                     const ViewEvidenceOptions& options, const StageReporter& reporter,
                     Reconstruction& result) {
  const StageLog::Timer timer = reporter.Begin("evidence");
  const double uncertain = result.uncertain.lengths.Sum();
  const std::vector<StretchEvidence> evidence =
      CollectEvidence(result.skeleton, result.radii, result.sequence, options.max_frames);
  reporter.observer.OnEvidence(name, result.skeleton, evidence);
  result.trust.wire_length = KeepProven(evidence, ProveWires(result.skeleton, evidence),
                                        min_probability, result.skeleton, result.uncertain);
  result.funnel.curves.unproven = result.uncertain.lengths;
  reporter.log.Count("evidence", "uncertain, m", result.uncertain.lengths.Sum());
  return result.uncertain.lengths.Sum() > uncertain;
}

void ReportAdjustment(const ColourAdjustment& adjusted, StageLog& log) {
  const char* stage = "colour adjustment";
  log.Count(stage, "frames", static_cast<double>(adjusted.frames.size()));
  log.Count(stage, "strips", adjusted.strips);
  log.Count(stage, "accepted share", adjusted.accepted_share);
  log.Count(stage, "depths", adjusted.depths);
  log.Count(stage, "residual before, px", adjusted.start_residual_px);
  log.Count(stage, "residual, px", adjusted.residual_px);
  log.Count(stage, "colour shift x, px", adjusted.color_shift_px.x());
  log.Count(stage, "colour shift y, px", adjusted.color_shift_px.y());
  if (!adjusted.skipped.empty()) log.Remark(stage, "skipped: " + adjusted.skipped);
}

// Deviation: what images look past is dropped, and what they show besides is added.
void CorrectBySilhouettes(const ColourAdjustment& adjusted, const BestOptions& options,
                          const StageReporter& reporter, Reconstruction& result) {
  if (options.silhouettes.max_frames == 0) return;
  const char* stage = "silhouettes";
  const StageLog::Timer timer = reporter.Begin(stage);
  const WireSilhouettes silhouettes(result.sequence, adjusted.frames, adjusted.posteriors,
                                    options.silhouettes.max_frames);
  if (!TellWires(silhouettes, result.skeleton)) {
    reporter.log.Remark(stage, kImagesDoNotTell);
    return;
  }
  // Two strands of noise that the adjustment has led into one wire.
  MergeParallelEdges(result.skeleton, 2 * result.radii.global_radius);
  const std::vector<Vec3> shown_by_depth = PlacesShownByDepth(
      CountViews(result.skeleton, result.sequence, options.evidence), result.skeleton);
  const SilhouetteChanges changes =
      CorrectTopology(silhouettes, options.silhouettes, shown_by_depth, result.skeleton);
  const int weak_wires =
      AddWeakWires(silhouettes, options.silhouettes.bridges, result.points, result.skeleton);
  TidyRidgeSkeleton(result.skeleton, options.ridge);
  result.funnel.curves.looked_past += changes.removed;
  reporter.log.Count(stage, "removed, m", changes.removed);
  reporter.log.Count(stage, "rungs", changes.rungs);
  reporter.log.Count(stage, "continued", changes.continued);
  reporter.log.Count(stage, "forks", changes.forks);
  reporter.log.Count(stage, "bridges", changes.bridges);
  reporter.log.Count(stage, "joins", changes.joins);
  reporter.log.Count(stage, "weak wires", weak_wires);
  reporter.observer.OnGraph("corrected", result.skeleton);
}

// Deviation: wires that depth has lost, where colour images show strips that no curve explains.
// Whether there are any.
bool AddWiresFromColour(const ColourAdjustment& adjusted, const RidgeOptions& options,
                        const StageReporter& reporter, Reconstruction& result) {
  const char* stage = "wires from colour";
  const StageLog::Timer timer = reporter.Begin(stage);
  StripViews views(result.skeleton, result.sequence, adjusted.frames, adjusted.posteriors);
  const double radius = result.radii.unmeasured_radius;
  const double followed = TrackTips(radius, views, result.skeleton);
  const ObservedPoints candidates = FindColourCandidates(views);
  const double added =
      followed + AddCandidateCurves(candidates, options, radius, views, result.skeleton);
  reporter.log.Count(stage, "followed, m", followed);
  reporter.log.Count(stage, "points", static_cast<double>(candidates.size()));
  reporter.log.Count(stage, "added, m", added);
  reporter.observer.OnPoints("colour_candidates", candidates);
  if (added == 0) return false;
  CloseFreeEnds(result.skeleton, options.free_ends, candidates);
  TidyRidgeSkeleton(result.skeleton, options);
  result.trust.wire_length += added;
  reporter.observer.OnGraph("with_colour", result.skeleton);
  return true;
}

// Deviation: curves of known radius and poses as exact as the colour images show them. Nothing
// where nothing was changed.
std::optional<ColourAdjustment> AdjustCurvesAndPoses(const Sequence& given,
                                                     const ColourAdjustmentOptions& options,
                                                     const StageReporter& reporter,
                                                     Reconstruction& result) {
  if (!options.enabled || result.skeleton.empty()) return std::nullopt;
  const StageLog::Timer timer = reporter.Begin("colour adjustment");
  std::vector<RigidTransform> T_world_given;
  for (const SequenceFrame& frame : given.frames) T_world_given.push_back(frame.T_world_camera);
  ColourAdjustment adjusted =
      AdjustToColours(result.skeleton, result.sequence, T_world_given, options);
  result.skeleton = adjusted.skeleton;
  for (size_t i = 0; i < result.sequence.frames.size(); ++i) {
    result.sequence.frames[i].T_world_camera = adjusted.T_world_camera[i];
  }
  result.sequence.color_camera.cx += adjusted.color_shift_px.x();
  result.sequence.color_camera.cy += adjusted.color_shift_px.y();
  ReportAdjustment(adjusted, reporter.log);
  result.trust.adjusted = adjusted.skipped.empty();
  result.trust.residual_before_px = adjusted.start_residual_px;
  result.trust.residual_px = adjusted.residual_px;
  reporter.observer.OnGraph("adjusted", result.skeleton);
  return adjusted.skipped.empty() ? std::optional(std::move(adjusted)) : std::nullopt;
}

// Deviation: wires that depth has missed and colour images show.
void AddMissedWires(const WireCompletionOptions& options, const StageReporter& reporter,
                    Reconstruction& result) {
  if (!options.enabled || result.skeleton.empty()) return;
  const StageLog::Timer timer = reporter.Begin("wire completion");
  CompletedWires completed = CompleteWires(result.skeleton, result.sequence, options);
  result.skeleton = std::move(completed.skeleton);
  reporter.log.Count("wire completion", "added", completed.added);
  reporter.log.Count("wire completion", "rejected", completed.rejected);
  reporter.observer.OnGraph("completed", result.skeleton);
}

// Deviation: without an adjustment, what the images look past is dropped by the colours first
// learned.
void PruneUnadjusted(const WireColours& colours, const SilhouetteOptions& options,
                     const StageReporter& reporter, Reconstruction& result) {
  const bool is_told = !colours.posterior.empty() && !result.skeleton.empty();
  if (!is_told || options.max_frames == 0) return;
  const char* stage = "silhouettes";
  const StageLog::Timer timer = reporter.Begin(stage);
  const std::optional<double> removed =
      PruneByColour(result.sequence, colours, options, result.skeleton);
  if (!removed) {
    reporter.log.Remark(stage, kImagesDoNotTell);
    return;
  }
  result.funnel.curves.looked_past += *removed;
  reporter.log.Count(stage, "removed, m", *removed);
  reporter.observer.OnGraph("corrected", result.skeleton);
}

// In how many images every place of the result was looked for and seen.
void LookForEvidence(const ViewEvidenceOptions& options, const StageReporter& reporter,
                     Reconstruction& result) {
  const StageLog::Timer timer = reporter.Begin("evidence");
  result.views = CountViews(result.skeleton, result.sequence, options);
  AssignObservations(result.views, result.skeleton);
  reporter.log.Count("evidence", "frames", result.views.frames);
}

}  // namespace

RadiusEstimate MeasureRadii(const SkeletonGraph& skeleton, const Sequence& sequence,
                            double row_diameter, const RadiusOptions& options,
                            const StageReporter& reporter) {
  const StageLog::Timer timer = reporter.Begin("radius");
  RadiusEstimate estimate = EstimateRadius(skeleton, sequence, AllFrames(sequence), options);
  // Strips of wires so close that none stands alone are not measured one by one.
  if (estimate.global_radius == 0) {
    estimate.global_radius = estimate.unmeasured_radius = 0.5 * row_diameter;
  }
  reporter.log.Count("radius", "strips", static_cast<double>(estimate.strips.size()));
  return estimate;
}

void RefineByColour(const Sequence& given, const SegmentationModel& model,
                    const BestOptions& options, const StageReporter& reporter,
                    Reconstruction& result) {
  const auto measure_radii = [&] {
    AssignMeasuredRadii(model.row_diameter, options.radius, reporter, result);
  };
  const auto keep_proven = [&](const std::string& name, double share) {
    const double min_probability = share * options.evidence.min_probability;
    if (KeepProvenWires(name, min_probability, options.evidence, reporter, result)) measure_radii();
  };
  measure_radii();
  // Nothing is to be added to what is hardly a wire.
  keep_proven("evidence_before_colour", kHardlyAWire);
  AddMissedWires(options.completion, reporter, result);
  const std::optional<ColourAdjustment> adjusted =
      AdjustCurvesAndPoses(given, options.colour_adjustment, reporter, result);
  if (adjusted) {
    CorrectBySilhouettes(*adjusted, options, reporter, result);
  } else {
    PruneUnadjusted(model.colours, options.silhouettes, reporter, result);
  }
  measure_radii();
  keep_proven("evidence", 1);
  // Depth looks past most of these: they have their proof from the images that show them.
  if (adjusted && AddWiresFromColour(*adjusted, options.ridge, reporter, result)) measure_radii();
  LookForEvidence(options.evidence, reporter, result);
}

}  // namespace curvefusion
