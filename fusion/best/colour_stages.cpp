#include "fusion/best/colour_stages.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/curve_graph/candidate_curves.h"
#include "fusion/curve_graph/colour_candidates.h"
#include "fusion/curve_graph/selection.h"
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

void AssignMeasuredRadii(RunContext& run, Reconstruction& result) {
  result.radii = MeasureRadii(result.skeleton, result.sequence, run);
  AssignRadii(result.radii, run.options.radius, result.skeleton);
}

// Thin by proof: what is a wire with less than `min_probability` leaves the result. Radii come
// before and are measured again where edges were cut.
void KeepProvenWires(const std::string& name, double min_probability, RunContext& run,
                     Reconstruction& result) {
  const double uncertain = result.uncertain.lengths.Sum();
  {
    const StageLog::Timer timer(run.log, "evidence");
    run.observer.OnProgress("evidence", 0, 1);
    const std::vector<StretchEvidence> evidence = CollectEvidence(
        result.skeleton, result.radii, result.sequence, run.options.evidence.max_frames);
    run.observer.OnEvidence(name, result.skeleton, evidence);
    result.trust.wire_length = KeepProven(evidence, ProveWires(result.skeleton, evidence),
                                          min_probability, result.skeleton, result.uncertain);
  }
  run.funnel.curves.unproven = result.uncertain.lengths;
  run.log.Count("evidence", "uncertain, m", result.uncertain.lengths.Sum());
  if (result.uncertain.lengths.Sum() > uncertain) AssignMeasuredRadii(run, result);
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
void CorrectBySilhouettes(const ColourAdjustment& adjusted, RunContext& run,
                          Reconstruction& result) {
  if (run.options.silhouettes.max_frames == 0) return;
  const char* stage = "silhouettes";
  const StageLog::Timer timer(run.log, stage);
  run.observer.OnProgress(stage, 0, 1);
  const WireSilhouettes silhouettes(result.sequence, adjusted.frames, adjusted.posteriors,
                                    run.options.silhouettes.max_frames);
  if (!TellWires(silhouettes, result.skeleton)) {
    run.log.Remark(stage, kImagesDoNotTell);
    return;
  }
  // Two strands of noise that the adjustment has led into one wire.
  MergeParallelEdges(result.skeleton, 2 * result.radii.global_radius);
  const std::vector<Vec3> shown_by_depth = PlacesShownByDepth(
      CountViews(result.skeleton, result.sequence, run.options.evidence), result.skeleton);
  const SilhouetteChanges changes =
      CorrectTopology(silhouettes, run.options.silhouettes, shown_by_depth, result.skeleton);
  const int weak_wires =
      AddWeakWires(silhouettes, run.options.silhouettes.bridges, result.points, result.skeleton);
  TidyRidgeSkeleton(result.skeleton, run.options.ridge);
  run.funnel.curves.looked_past += changes.removed;
  run.log.Count(stage, "removed, m", changes.removed);
  run.log.Count(stage, "rungs", changes.rungs);
  run.log.Count(stage, "continued", changes.continued);
  run.log.Count(stage, "forks", changes.forks);
  run.log.Count(stage, "bridges", changes.bridges);
  run.log.Count(stage, "joins", changes.joins);
  run.log.Count(stage, "weak wires", weak_wires);
  run.observer.OnGraph("corrected", result.skeleton);
}

// Deviation: wires that depth has lost, where colour images show strips that no curve explains.
// Whether there are any.
bool AddWiresFromColour(const ColourAdjustment& adjusted, RunContext& run, Reconstruction& result) {
  const char* stage = "wires from colour";
  const StageLog::Timer timer(run.log, stage);
  run.observer.OnProgress(stage, 0, 1);
  const ObservedPoints candidates =
      FindColourCandidates(result.skeleton, result.sequence, adjusted.frames, adjusted.posteriors);
  const double added = AddCandidateCurves(candidates, run.options.ridge,
                                          result.radii.unmeasured_radius, result.skeleton);
  run.log.Count(stage, "points", static_cast<double>(candidates.size()));
  run.log.Count(stage, "added, m", added);
  run.observer.OnPoints("colour_candidates", candidates);
  if (added == 0) return false;
  TidyRidgeSkeleton(result.skeleton, run.options.ridge);
  result.trust.wire_length += added;
  run.observer.OnGraph("with_colour", result.skeleton);
  return true;
}

// Deviation: curves of known radius and poses as exact as the colour images show them. Nothing
// where nothing was changed.
std::optional<ColourAdjustment> AdjustCurvesAndPoses(const Sequence& given, RunContext& run,
                                                     Reconstruction& result) {
  if (!run.options.colour_adjustment.enabled || result.skeleton.empty()) return std::nullopt;
  const StageLog::Timer timer(run.log, "colour adjustment");
  run.observer.OnProgress("colour adjustment", 0, 1);
  std::vector<RigidTransform> T_world_given;
  for (const SequenceFrame& frame : given.frames) T_world_given.push_back(frame.T_world_camera);
  ColourAdjustment adjusted = AdjustToColours(result.skeleton, result.sequence, T_world_given,
                                              run.options.colour_adjustment);
  result.skeleton = adjusted.skeleton;
  for (size_t i = 0; i < result.sequence.frames.size(); ++i) {
    result.sequence.frames[i].T_world_camera = adjusted.T_world_camera[i];
  }
  result.sequence.color_camera.cx += adjusted.color_shift_px.x();
  result.sequence.color_camera.cy += adjusted.color_shift_px.y();
  ReportAdjustment(adjusted, run.log);
  result.trust.adjusted = adjusted.skipped.empty();
  result.trust.residual_before_px = adjusted.start_residual_px;
  result.trust.residual_px = adjusted.residual_px;
  run.observer.OnGraph("adjusted", result.skeleton);
  return adjusted.skipped.empty() ? std::optional(std::move(adjusted)) : std::nullopt;
}

// Deviation: wires that depth has missed and colour images show.
void AddMissedWires(RunContext& run, Reconstruction& result) {
  if (!run.options.completion.enabled || result.skeleton.empty()) return;
  const StageLog::Timer timer(run.log, "wire completion");
  run.observer.OnProgress("wire completion", 0, 1);
  CompletedWires completed =
      CompleteWires(result.skeleton, result.sequence, run.options.completion);
  result.skeleton = std::move(completed.skeleton);
  run.log.Count("wire completion", "added", completed.added);
  run.log.Count("wire completion", "rejected", completed.rejected);
  run.observer.OnGraph("completed", result.skeleton);
}

// Deviation: without an adjustment, what the images look past is dropped by the colours first
// learned.
void PruneUnadjusted(RunContext& run, Reconstruction& result) {
  const bool is_told = !run.colours.posterior.empty() && !result.skeleton.empty();
  if (!is_told || run.options.silhouettes.max_frames == 0) return;
  const char* stage = "silhouettes";
  const StageLog::Timer timer(run.log, stage);
  run.observer.OnProgress(stage, 0, 1);
  const std::optional<double> removed =
      PruneByColour(result.sequence, run.colours, run.options.silhouettes, result.skeleton);
  if (!removed) {
    run.log.Remark(stage, kImagesDoNotTell);
    return;
  }
  run.funnel.curves.looked_past += *removed;
  run.log.Count(stage, "removed, m", *removed);
  run.observer.OnGraph("corrected", result.skeleton);
}

// In how many images every place of the result was looked for and seen.
void LookForEvidence(RunContext& run, Reconstruction& result) {
  const StageLog::Timer timer(run.log, "evidence");
  run.observer.OnProgress("evidence", 0, 1);
  result.views = CountViews(result.skeleton, result.sequence, run.options.evidence);
  AssignObservations(result.views, result.skeleton);
  run.log.Count("evidence", "frames", result.views.frames);
}

}  // namespace

RadiusEstimate MeasureRadii(const SkeletonGraph& skeleton, const Sequence& sequence,
                            RunContext& run) {
  const StageLog::Timer timer(run.log, "radius");
  run.observer.OnProgress("radius", 0, 1);
  RadiusEstimate estimate =
      EstimateRadius(skeleton, sequence, AllFrames(sequence), run.options.radius);
  // Strips of wires so close that none stands alone are not measured one by one.
  if (estimate.global_radius == 0) {
    estimate.global_radius = estimate.unmeasured_radius = 0.5 * run.row_diameter;
  }
  run.log.Count("radius", "strips", static_cast<double>(estimate.strips.size()));
  return estimate;
}

void RefineByColour(const Sequence& given, RunContext& run, Reconstruction& result) {
  AssignMeasuredRadii(run, result);
  // Nothing is to be added to what is hardly a wire.
  KeepProvenWires("evidence_before_colour", kHardlyAWire * run.options.evidence.min_probability,
                  run, result);
  AddMissedWires(run, result);
  const std::optional<ColourAdjustment> adjusted = AdjustCurvesAndPoses(given, run, result);
  if (adjusted) {
    CorrectBySilhouettes(*adjusted, run, result);
  } else {
    PruneUnadjusted(run, result);
  }
  AssignMeasuredRadii(run, result);
  KeepProvenWires("evidence", run.options.evidence.min_probability, run, result);
  // Depth looks past most of these: they have their proof from the images that show them.
  if (adjusted && AddWiresFromColour(*adjusted, run, result)) AssignMeasuredRadii(run, result);
  LookForEvidence(run, result);
}

}  // namespace curvefusion
