#include "fusion/best/colour_stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fusion/best/colour_fit.h"
#include "fusion/best/colour_start.h"
#include "fusion/best/finish_curves.h"
#include "fusion/curve_graph/candidate_curves.h"
#include "fusion/curve_graph/colour_candidates.h"
#include "fusion/curve_graph/selection.h"
#include "fusion/curve_graph/strip_views.h"
#include "fusion/curve_graph/tip_tracking.h"
#include "fusion/curve_graph/wire_proof.h"
#include "fusion/silhouettes/colour_pruning.h"
#include "graph/edge_parts.h"
#include "graph/intersections.h"
#include "graph/sampled_curves.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr const char* kAskedFor = "asked for";
constexpr const char* kImagesDoNotTell =
    "skipped: the images do not show the curves as wire throughout";
// Chosen: before poses and curves are adjusted to colours more is given the benefit of the doubt.
constexpr double kHardlyAWire = 0.4;  // times evidence.min_probability
// Chosen: metres; curves are adjusted by some millimetres, and what is added goes on beside them.
constexpr double kBesideDepth = 0.008;
constexpr double kBetweenPlaces = 0.25 * kBesideDepth;
// Measured: 1.7 to 4.7 where depth shows wires in their places, mostly 5.7 and more with time of
// flight (docs/wires_from_colour.md); 19 of a cable by a D400 from .3 m, where colour's curves are
// not taken (docs/lab_notebook.md).
constexpr double kWrongScatter = 5;
// Chosen: time of flight has 3.9 and more where curves are first adjusted; 23 scans by other
// cameras do not change by it (docs/lab_notebook.md).
constexpr double kDoubtfulScatter = 3.5;
constexpr double kLittle = 0.01;  // of the length; less is not worth another round

// For and against what depth can speak.
struct DepthEvidence {
  int images = 0;            // looked at, at most; 0 = depth does not show wires
  const Nets& nets;          // which it shows as surfaces
  std::vector<Vec3> curves;  // places on those that it shows; empty = on all
};

// Depth shows a net as one surface: that it goes on beside a curve says nothing there. And what
// colour adds are wires that depth has lost: that depth looks past them says nothing either.
void DisregardDepth(const DepthEvidence& depth, const SkeletonGraph& skeleton,
                    std::vector<StretchEvidence>& evidence) {
  const PointIndex shown(depth.curves);
  for (StretchEvidence& stretch : evidence) {
    const Polyline& points = skeleton.edge(stretch.edge).points;
    stretch.same *=
        1 - ShareOf(points, stretch.part, [&](const Vec3& p) { return depth.nets.Contains(p); });
    if (depth.curves.empty()) continue;
    const Vec3& nearest = depth.curves[static_cast<size_t>(shown.Nearest(stretch.middle))];
    if ((nearest - stretch.middle).norm() > kBesideDepth) stretch.images = 0;
  }
}

// Thin by proof: what is not likely enough a wire leaves the result, by depth and the strips of all
// radii, which come before. Whether any wire left: then edges were cut, and radii are to be
// measured again.
bool KeepProvenWires(const std::string& stage, const std::string& name, const ProofLimits& limits,
                     const DepthEvidence& depth, const StageReporter& reporter,
                     Reconstruction& result) {
  const StageLog::Timer timer = reporter.Begin(stage);
  const double uncertain = result.uncertain.lengths.Sum();
  std::vector<StretchEvidence> evidence = CollectEvidence(
      result.skeleton, result.radii, result.sequence, depth.images, result.skeleton);
  DisregardDepth(depth, result.skeleton, evidence);
  reporter.observer.OnTable(name, [&] { return EvidenceCsv(result.skeleton, evidence); });
  const std::vector<WireProof> proofs =
      ProveWires(result.skeleton, evidence, result.uncertain.beside_kept);
  result.trust.wire_length =
      KeepProven(evidence, proofs, limits, result.skeleton, result.uncertain);
  result.funnel.curves.unproven = result.uncertain.lengths;
  reporter.log.Count(stage, "uncertain, m", result.uncertain.lengths.Sum());
  return result.uncertain.lengths.Sum() > uncertain;
}

// The strips of the images that curves were adjusted to, around these.
StripViews LookForStrips(const ColourAdjustment& adjusted, const StageReporter& reporter,
                         const Reconstruction& result) {
  const StageLog::Timer timer = reporter.Begin("strips");
  return {result.sequence, adjusted.frames, adjusted.posteriors, BoundsOf(result.skeleton)};
}

// Deviation: what images look past is dropped, and what they show besides is added.
void CorrectBySilhouettes(const ColourAdjustment& adjusted, const StripViews& strips,
                          WireDepth depth, const BestOptions& options,
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
  // Parallel curves of noise that the adjustment has led into one wire: axes of two wires are never
  // so near.
  ResolveIntersections(result.skeleton, result.radii.global_radius);
  std::vector<Vec3> shown_by_depth;
  if (depth == WireDepth::kShown) {
    shown_by_depth = PlacesShownByDepth(
        CountViews(result.skeleton, result.sequence, options.evidence), result.skeleton);
  }
  const SilhouetteChanges changes = CorrectTopology(
      silhouettes, [&strips](const Polyline& points) { return strips.SharesAlong(points); },
      options.silhouettes, shown_by_depth, result.skeleton);
  TidyRidgeSkeleton(result.skeleton, options.ridge);
  result.funnel.curves.looked_past += changes.removed;
  reporter.log.CountMore(stage, "removed, m", changes.removed);
  reporter.log.CountMore(stage, "continued", changes.continued);
  reporter.log.CountMore(stage, "bridges", changes.bridges);
  reporter.log.CountMore(stage, "joins", changes.joins);
  reporter.observer.OnGraph("corrected", result.skeleton);
}

// Deviation: wires that depth has lost, where colour images show strips that no curve explains.
// How many metres.
double AddWiresFromColour(StripViews& views, WireDepth depth, int round,
                          const RidgeOptions& options, const StageReporter& reporter,
                          Reconstruction& result) {
  const char* stage = "wires from colour";
  const StageLog::Timer timer = reporter.Begin(stage);
  views.ExplainAll(result.skeleton);
  const double radius = result.radii.unmeasured_radius;
  const double followed = TrackTips(radius, views, result.skeleton);
  const ObservedPoints candidates = FindColourCandidates(
      views, {.follow = depth == WireDepth::kLookedPast, .max_rays = kManyRays},
      [&](int64_t done, int64_t total) { reporter.observer.OnProgress(stage, done, total); });
  const AddedCurves from_candidates =
      AddCandidateCurves(result.sequence, candidates, options, radius, views, result.skeleton);
  const double added = followed + from_candidates.length;
  reporter.log.CountMore(stage, "followed, m", followed);
  reporter.log.Count(stage, "points", static_cast<double>(candidates.size()));
  reporter.log.CountMore(stage, "added, m", added);
  reporter.observer.OnPoints("colour_candidates", candidates);
  reporter.observer.OnTable(fmt::format("colour_stretches_{}", round + 1),
                            [&] { return StretchesCsv(from_candidates.stretches); });
  if (added == 0) return 0;
  TidyRidgeSkeleton(result.skeleton, options);
  result.trust.wire_length += added;
  reporter.observer.OnGraph("with_colour", result.skeleton);
  return added;
}

// Deviation: arrays of close wires have no strips to be adjusted to; what the images look past
// between them is dropped by the colours first learned.
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

// Why curves are sought in colour images alone; empty where they are not.
std::string WhyColourStart(const Sequence& given, const BestOptions& options,
                           const std::optional<ColourAdjustment>& adjusted,
                           const Reconstruction& result) {
  if (!options.colour_adjustment.enabled || options.depth.use == DepthRole::kWires) return {};
  if (!given.has_depth) {
    return options.depth.use == DepthRole::kNone ? kAskedFor : "the scan has no depth images";
  }
  if (options.depth.use == DepthRole::kBackground) return kAskedFor;
  if (result.skeleton.empty()) return "depth shows no wire";
  if (!adjusted) return "the colour images do not agree with the curves that depth shows";
  if (adjusted->depth_scatter <= kWrongScatter) return {};
  return fmt::format("depth scatters about the curves {:.1f} times as much as about a plane",
                     adjusted->depth_scatter);
}

// What is to come, now that more is known.
void TellPlan(RunSize& size, const BestOptions& options, const StageReporter& reporter,
              const Reconstruction& result) {
  size.SetCurves(result.skeleton);
  reporter.observer.OnPlan(PlanBest(result.sequence, options, size));
}

// A scan with the poses that curves from colour alone are looked for with, and how they err.
struct HeldScan {
  Sequence sequence;
  PoseErrors errors;
};

HeldScan Held(const PosedScan& scan) {
  return scan.hold ? HeldScan{scan.hold(), PoseErrors::kJitter}
                   : HeldScan{scan.sequence, scan.errors};
}

// Curves from colour alone where depth does not serve, and what depth then was used for.
void StartFromColourWhereDepthFails(const PosedScan& scan, const WireColours& colours,
                                    RunSize& size, const BestOptions& options,
                                    const StageReporter& reporter, AdjustmentStart& start,
                                    std::optional<ColourAdjustment>& adjusted,
                                    Reconstruction& result) {
  const std::string why = WhyColourStart(scan.given, options, adjusted, result);
  const bool is_asked_for = options.depth.use == DepthRole::kWires;
  result.depth = {DepthRoleName(DepthRole::kWires),
                  is_asked_for ? kAskedFor : "colour gave no reason against its curves"};
  if (why.empty()) return;
  size.by_colour = true;
  TellPlan(size, options, reporter, result);
  const auto [given, errors] = Held(scan);
  const DepthCurves depth_curves = result.skeleton.empty() ? DepthCurves::kNone
                                   : adjusted              ? DepthCurves::kMisplaced
                                                           : DepthCurves::kDoubtful;
  std::optional<ColourCurves> from_colour =
      given.has_depth
          ? StartFromColour(given, errors, colours, depth_curves, options, reporter, result)
          : StartWithoutDepth(given, options, reporter, result);
  if (!from_colour && depth_curves == DepthCurves::kDoubtful) {
    from_colour =
        StartFromColour(given, errors, {}, DepthCurves::kNoHelp, options, reporter, result);
  }
  if (from_colour) {
    adjusted = std::move(from_colour->adjusted);
    start = std::move(from_colour->start);
  }
  if (from_colour || !given.has_depth) {
    const DepthRole role = given.has_depth ? DepthRole::kBackground : DepthRole::kNone;
    result.depth = {DepthRoleName(role), why};
    return;
  }
  result.depth.why = why + ", but colour alone gives no better curves";
  size.by_colour = false;
  TellPlan(size, options, reporter, result);
}

// Depth's curves fitted to images alone where depth scatters about them, but not so much that
// others were sought.
void FitWithoutDepth(const PosedScan& scan, SkeletonGraph unadjusted, const BestOptions& options,
                     const StageReporter& reporter, AdjustmentStart& start,
                     std::optional<ColourAdjustment>& adjusted, Reconstruction& result) {
  const bool is_given = start.depth == WireDepth::kShown && options.depth.use == DepthRole::kAuto;
  if (!is_given || !adjusted) return;
  const double scatter = adjusted->depth_scatter;
  if (scatter <= kDoubtfulScatter || scatter > kWrongScatter) return;
  const auto [held, errors] = Held(scan);
  std::optional<ColourCurves> fitted = FitToColourAlone(std::move(unadjusted), held, errors,
                                                        start.colours, options, reporter, result);
  if (!fitted) return;
  result.depth.why = fmt::format(
      "depth scatters about the curves {:.1f} times as much as about a plane: they were fitted to "
      "the colour images alone",
      scatter);
  adjusted = std::move(fitted->adjusted);
  start = std::move(fitted->start);
}

// Adds wires that colour images show, fits curves and poses to the images again and corrects them,
// until little is added: a new curve lies where places were found, some millimetres beside its
// strips, and explains strips for which lines of sight had several places. Depth looks past most of
// these wires: they have their proof from the images that show them.
void CompleteByColour(const AdjustmentStart& start, std::optional<StripViews> strips,
                      double array_diameter, RunSize size, const BestOptions& options,
                      const StageReporter& reporter, Reconstruction& result) {
  for (int round = 0; round < kColourRounds; ++round) {
    TellPlan(size, options, reporter, result);
    const double added =
        AddWiresFromColour(*strips, start.depth, round, options.ridge, reporter, result);
    strips.reset();  // its images take as much memory as the next adjustment
    // Without depth, silhouettes have bridged gaps that nothing was adjusted to yet.
    const bool is_rough = round == 0 && !result.sequence.has_depth;
    const bool is_little = added <= 0 || added < kLittle * result.skeleton.TotalLength();
    size.has_last_round = is_little && !is_rough;
    if (!size.has_last_round) ++size.rounds;
    TellPlan(size, options, reporter, result);
    if (added != 0) AssignMeasuredRadii(array_diameter, options.radius, reporter, result);
    if (size.has_last_round) break;
    const auto before = result.trust;
    const std::optional<ColourAdjustment> adjusted =
        AdjustCurvesAndPoses(start, options.colour_adjustment, reporter, result);
    if (!adjusted) {
      result.trust = before;  // of the adjustment that stands
      break;
    }
    result.trust.residual_before_px = before.residual_before_px;
    strips = LookForStrips(*adjusted, reporter, result);
    CorrectBySilhouettes(*adjusted, *strips, start.depth, options, reporter, result);
    AssignMeasuredRadii(array_diameter, options.radius, reporter, result);
  }
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

void RefineByColour(const PosedScan& scan, const LearnedWires& wires, RunSize size,
                    const BestOptions& options, const StageReporter& reporter,
                    Reconstruction& result) {
  const auto measure_radii = [&] {
    AssignMeasuredRadii(wires.array_diameter, options.radius, reporter, result);
  };
  AdjustmentStart start = {CameraPoses(scan.sequence), scan.errors,
                           scan.given.has_depth ? WireDepth::kShown : WireDepth::kNotShown,
                           wires.colours.posterior};
  const double min_probability = options.evidence.min_probability;
  DepthEvidence depth = {.nets = wires.nets};
  const auto keep_proven = [&](const std::string& stage, const std::string& name,
                               const ProofLimits& limits) {
    depth.images = start.depth == WireDepth::kShown ? options.evidence.max_frames : 0;
    if (KeepProvenWires(stage, name, limits, depth, reporter, result)) measure_radii();
  };
  TellPlan(size, options, reporter, result);
  measure_radii();
  // Nothing is to be adjusted to what is hardly a wire.
  keep_proven("evidence", "evidence_before_colour", {.usual = kHardlyAWire * min_probability});
  SkeletonGraph unadjusted = result.skeleton;
  std::optional<ColourAdjustment> adjusted =
      AdjustCurvesAndPoses(start, options.colour_adjustment, reporter, result);
  StartFromColourWhereDepthFails(scan, wires.colours, size, options, reporter, start, adjusted,
                                 result);
  FitWithoutDepth(scan, std::move(unadjusted), options, reporter, start, adjusted, result);
  std::optional<StripViews> strips;
  if (adjusted) {
    strips = LookForStrips(*adjusted, reporter, result);
    CorrectBySilhouettes(*adjusted, *strips, start.depth, options, reporter, result);
  } else if (wires.array_spacing > 0) {
    PruneUnadjusted(wires.colours, options.silhouettes, reporter, result);
  }
  measure_radii();
  const ProofLimits limits = LimitsOf(options.evidence);
  const auto complete = [&] {
    if (!adjusted) return;
    adjusted.reset();  // its images are not needed any more
    depth.curves = SampleCurvesOf(result.skeleton, kBetweenPlaces).positions;
    CompleteByColour(start, std::move(strips), wires.array_diameter, size, options, reporter,
                     result);
    strips.reset();
  };
  // What colour adds tells of wires that depth shows in parts; nothing is to be added to what is no
  // wire where all curves are colour's.
  if (start.depth == WireDepth::kShown) complete();
  keep_proven("evidence", "evidence", limits);
  const bool is_unmeasured = !result.skeleton.empty() && result.radii.global_radius == 0;
  if (min_probability > 0 && is_unmeasured) {
    keep_proven("evidence again", "evidence_again", {.usual = limits.doubtful});
  }
  complete();
  FinishCurves(wires, options, reporter, result);
  LookForEvidence(options.evidence, reporter, result);
}

}  // namespace curvefusion
