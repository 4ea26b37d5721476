#include "fusion/best/best_plan.h"

#include <algorithm>
#include <utility>

#include "capture/content/geometry_check.h"
#include "fusion/adjustment/colour_frames.h"
#include "fusion/curve_graph/strip_views.h"
#include "graph/graph_figures.h"

namespace curvefusion {

namespace {

// Chosen, until something was found: points a frame and metres of curve, between those of the real
// and the simulated scans of docs/results_details.md#time-left.
constexpr double kPointsPerFrame = 500;
constexpr double kLength = 3;
// The image size that costs were measured at.
constexpr double kPixels = 640 * 480;
// How many rounds follow. Free ends are where wires go on that depth has lost: of 17 training scans
// 4 of the 6 with at most 6 of them after the registration of bundles had no further round, 9 of
// the 11 with 8 to 20 had one to six. Chosen on these and 10 validation scans so that the length of
// the run is foretold within 30 % most of the time; the mean number of rounds would foretell too
// much for most, as few have many.
constexpr double kRoundsPerFreeEnd = 0.1;
constexpr double kMostRounds = 1.5, kUnknownRounds = 0.5;

// What a run consists of, in the units that costs depend on.
struct Amounts {
  double size;         // of images, in kPixels
  double looked_size;  // of those that strips are looked for in
  double tried;        // frames whose poses are held to surfaces to tell whether all are to be
  double held;         // frames whose poses are then held
  double integrated;   // frames of the volume
  double frames;       // segmented
  double bundles;
  double learned;   // frames that surfaces and colours are learned from
  double points;    // in 100,000
  double length;    // metres of curve
  double strips;    // colour images that radii are measured in
  double adjusted;  // colour images that curves are adjusted to
  double searched;  // colour images that wires are looked for in
  double looked;    // depth images that evidence is looked for in
};

double SizeOf(const PinholeCamera& camera) {
  return static_cast<double>(camera.width) * camera.height / kPixels;
}

Amounts AmountsOf(const Sequence& sequence, const BestOptions& options, const RunSize& size) {
  const double frames = sequence.frame_count();
  const double points = size.points > 0 ? size.points : kPointsPerFrame * frames;
  const auto adjusted = static_cast<double>(
      ChooseColourFrames(sequence, options.colour_adjustment.frame_stride).size());
  return {.size = SizeOf(sequence.depth_camera),
          .looked_size = SizeOf(StripViews::CameraLookedThrough(sequence.color_camera)),
          .tried = options.depth.hold_to_surfaces
                       ? static_cast<double>(FramesOfGain(sequence).size())
                       : 0,
          .held = size.holds_poses ? frames : 0,
          .integrated = frames / options.volume_stride,
          .frames = frames,
          .bundles = frames / options.segmentation.bundle.frames,
          .learned = std::min<double>(frames, options.segmentation.gate.frames),
          .points = points / 1e5,
          .length = size.length > 0 ? size.length : kLength,
          .strips = std::min<double>(frames, options.radius.max_frames),
          .adjusted = adjusted,
          .searched = std::min<double>(adjusted, StripViews::kMaxViews),
          .looked = std::min<double>(frames, options.evidence.max_frames)};
}

// How likely one more round is: as if each were the last by chance, as the others are.
double AnotherRound(const RunSize& size) {
  if (size.has_last_round) return 0;
  const double rounds =
      size.free_ends ? std::min(kMostRounds, kRoundsPerFreeEnd * *size.free_ends) : kUnknownRounds;
  return rounds / (1 + rounds);
}

// Seconds of one thread, fitted to the scans of docs/results_details.md#time-left.
class Costs {
 public:
  explicit Costs(const Amounts& amounts) : a_(amounts) {}

  PlannedStage Radius() const { return {"radius", 0.0035 * a_.size * a_.strips}; }
  PlannedStage Evidence() const { return {"evidence", 0.0033 * a_.size * a_.looked}; }
  PlannedStage Adjustment() const {
    return {"colour adjustment", a_.adjusted * (0.008 * a_.size + 0.0045 * a_.length)};
  }
  PlannedStage Strips() const { return {"strips", 0.029 * a_.looked_size * a_.adjusted}; }
  PlannedStage Silhouettes() const {
    return {"silhouettes", a_.adjusted * (0.005 * a_.size + 0.0012 * a_.length)};
  }
  // Most of it goes into lines of sight, of which at most so many are looked at.
  PlannedStage Wires() const { return {"wires from colour", 0.02 * a_.searched}; }

  std::vector<PlannedStage> UntilContracted() const {
    return {{"hold to surfaces", 0.035 * a_.size * a_.tried},
            {"hold to surfaces", 0.035 * a_.size * a_.held},
            {"volume", 0.0083 * a_.size * a_.integrated},
            {"surfaces and colours", 0.09 * a_.size * a_.learned},
            {"segmentation", 0.031 * a_.size * a_.frames + 0.5 * a_.points},
            {"bundle registration", (0.2 + 0.05 * a_.bundles) * a_.points},
            {"contraction", 0.05 * a_.points},
            Radius(),
            {"frame registration", 0.004 * a_.frames + 0.3 * a_.points},
            {"contraction", 0.05 + 0.25 * a_.points}};
  }

  // Where curves are sought in colour images alone, in some scans with poses that are held now:
  // places that these agree on, twice.
  std::vector<PlannedStage> ByColour() const {
    std::vector<PlannedStage> stages = {{"hold to surfaces", 0}};
    for (int round = 0; round < 2; ++round) {
      stages.insert(stages.end(),
                    {{"wires from colour", 0.06 * a_.searched}, Radius(), Adjustment()});
    }
    return stages;
  }

 private:
  Amounts a_;
};

void Append(std::vector<PlannedStage> stages, double probability, std::vector<PlannedStage>& plan) {
  for (PlannedStage& stage : stages) {
    stage.cost *= probability;
    plan.push_back(std::move(stage));
  }
}

// Every stage that may run stands here, radii after a curve was left out among them: one that is
// not run is passed over, but one that is not here would be taken for a later stage of its name.
std::vector<PlannedStage> BestStages(const Costs& costs, const RunSize& size, bool has_depth) {
  std::vector<PlannedStage> plan;
  const PlannedStage radii_again = {"radius", 0};
  if (has_depth) {
    plan = costs.UntilContracted();
    Append({costs.Radius(), costs.Evidence(), radii_again, costs.Adjustment()}, 1, plan);
  }
  const double by_colour = size.by_colour ? 1 : 0;
  Append(costs.ByColour(), by_colour, plan);
  Append(costs.ByColour(), 0.5 * by_colour, plan);  // where that gives nothing
  Append({{"colour adjustment", 0}}, 1, plan);      // without depth, in few scans
  Append({costs.Strips(), costs.Silhouettes(), costs.Radius()}, 1, plan);
  // Colour's own curves are proven before more are added, those that depth shows with them.
  const bool is_proven_first = size.by_colour || !has_depth;
  const std::vector<PlannedStage> proof = {
      costs.Evidence(), radii_again, {"evidence again", 0}, radii_again};  // where few are wires
  Append(proof, is_proven_first ? 1 : 0, plan);
  double probability = 1;
  for (int round = 0; round < kColourRounds; ++round) {
    Append({costs.Wires(), costs.Radius()}, probability, plan);
    if (round >= size.rounds) probability *= AnotherRound(size);
    Append({costs.Adjustment(), costs.Strips(), costs.Silhouettes(), costs.Radius()}, probability,
           plan);
  }
  Append(proof, is_proven_first ? 0 : 1, plan);
  Append({{"nets", 0}, radii_again}, 1, plan);  // in few scans
  Append({costs.Evidence()}, 1, plan);
  return plan;
}

}  // namespace

void RunSize::SetCurves(const SkeletonGraph& skeleton) {
  const GraphFigures figures = MeasureGraph(skeleton);
  length = figures.length;
  free_ends = figures.free_ends;
}

std::vector<PlannedStage> PlanBest(const Sequence& sequence, const BestOptions& options,
                                   const RunSize& size) {
  return BestStages(Costs(AmountsOf(sequence, options, size)), size, sequence.has_depth);
}

std::vector<PlannedStage> PlanSegmentation(const Sequence& sequence, const BestOptions& options,
                                           double share) {
  std::vector<PlannedStage> stages = Costs(AmountsOf(sequence, options, {})).UntilContracted();
  const auto last = std::find_if(stages.begin(), stages.end(),
                                 [](const auto& stage) { return stage.name == "segmentation"; });
  last->cost *= share;
  stages.erase(last + 1, stages.end());
  return stages;
}

}  // namespace curvefusion
