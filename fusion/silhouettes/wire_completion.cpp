#include "fusion/silhouettes/wire_completion.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/adjustment/colour_frames.h"
#include "fusion/adjustment/curve_vertices.h"
#include "fusion/strips/strip_samples.h"
#include "fusion/strips/strip_tracking.h"
#include "kernel/parallel.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kBorderPx = 8;
constexpr double kMaxClearancePx = 40;
constexpr double kMaxForeshortening = 0.96;  // what depth loses is mostly seen nearly end on
constexpr double kCrossingPx = 4;            // half a crossing wire and its blur
constexpr double kCornerAngle = 1.0;         // the same as for smoothing

// How often a place was looked at where no other curve is in the way, and seen.
struct Looks {
  int clear = 0;
  int seen = 0;
  double Share() const { return clear > 0 ? static_cast<double>(seen) / clear : 0; }
};

// A way along which a wire is looked for.
struct Trial {
  size_t index;  // of the way that this is, or is a shifted version of
  BranchContinuation way;
  double radius;
  std::vector<CurveSample> samples;
  std::vector<Looks> looks;  // one for each sample
};

std::vector<CurveSample> SamplesAlong(const Polyline& curve, EdgeId edge, double step) {
  SkeletonGraph single;
  single.AddPolyline(curve);
  std::vector<CurveSample> samples = SampleStrips(single, step);
  for (CurveSample& sample : samples) sample.edge = edge;
  return samples;
}

// Whether most of the places that could be looked at are wire.
bool IsWire(const std::vector<Looks>& looks, const WireCompletionOptions& options) {
  int places = 0;
  int wire = 0;
  int seen = 0;
  for (const Looks& place : looks) {
    seen += place.seen;
    if (place.clear < options.min_looks) continue;
    ++places;
    wire += place.Share() >= options.min_share ? 1 : 0;
  }
  return seen >= options.min_seen && places > 0 && wire >= options.min_places * places;
}

double SeenShare(const std::vector<Looks>& looks) {
  Looks all;
  for (const Looks& place : looks) all = {all.clear + place.clear, all.seen + place.seen};
  return all.Share();
}

// The images, and what is known of the wires' colour.
class WireImages {
 public:
  WireImages(const SkeletonGraph& skeleton, const Sequence& sequence,
             const WireCompletionOptions& options)
      : options_(options),
        frames_(
            LoadColourFrames(sequence, EvenlyThinned(AllFrames(sequence), options.max_frames))) {
    problem_.color_camera = sequence.color_camera;
    problem_.T_color_depth = sequence.T_color_depth;
    for (const int i : frames_.indices) {
      T_color_world_.push_back(sequence.T_color_depth *
                               sequence.frames[i].T_world_camera.inverse());
    }
    const CurveVertices curves = SampleVertices(skeleton, options.step, kCornerAngle);
    CurvePoseState state;
    state.positions = curves.positions;
    for (const int i : frames_.indices) {
      state.T_camera_world.push_back(sequence.frames[i].T_world_camera.inverse());
    }
    LearnColours(ExpectStrips(curves, problem_, state), curves, frames_);
    LearnColours(TrackCurves(curves, problem_, state, frames_, options.search_px), curves, frames_);
  }

  // How often the places of each way were seen in all images. `skeleton` holds samples of all known
  // curves.
  void Look(const std::vector<CurveSample>& skeleton, std::vector<Trial>& trials) const {
    std::vector<CurveSample> samples;
    std::vector<double> radii;
    for (const Trial& trial : trials) {
      samples.insert(samples.end(), trial.samples.begin(), trial.samples.end());
      radii.resize(samples.size(), trial.radius);
    }
    std::vector<std::vector<Looks>> of_frame(frames_.size());
    ParallelFor(0, static_cast<int64_t>(frames_.size()), 1, [&](int64_t f) {
      of_frame[f] = LookInFrame(static_cast<size_t>(f), samples, radii, skeleton);
    });
    for (const std::vector<Looks>& frame : of_frame) {
      size_t next = 0;
      for (Trial& trial : trials) {
        for (Looks& looks : trial.looks) {
          looks.clear += frame[next].clear;
          looks.seen += frame[next++].seen;
        }
      }
    }
  }

 private:
  std::vector<Looks> LookInFrame(size_t f, const std::vector<CurveSample>& samples,
                                 const std::vector<double>& radii,
                                 const std::vector<CurveSample>& skeleton) const {
    std::vector<Looks> looks(samples.size());
    const std::vector<ProjectedSample> projected =
        ProjectSamples(samples, skeleton, problem_.color_camera, T_color_world_[f], kBorderPx,
                       kMaxClearancePx, {kMaxForeshortening, kCrossingPx});
    std::vector<double> projected_radii;
    for (const ProjectedSample& sample : projected) projected_radii.push_back(radii[sample.index]);
    for (const TrackedStrip& strip :
         TrackStrips(frames_.posteriors[f], projected, projected_radii, options_.search_px)) {
      const ProjectedSample& sample = projected[strip.sample];
      if (!IsClear(sample.clearance_px, sample.WidthPx(radii[sample.index]))) continue;
      ++looks[sample.index].clear;
      looks[sample.index].seen +=
          strip.accepted && std::abs(strip.offset_px) <= options_.max_offset_px ? 1 : 0;
    }
    return looks;
  }

  const WireCompletionOptions& options_;
  ColourFrames frames_;
  CurvePoseProblem problem_;
  std::vector<RigidTransform> T_color_world_;
};

double RadiusOf(const SkeletonGraph& skeleton, EdgeId id) {
  const std::vector<double>& radii = skeleton.edge(id).radii;
  return radii.empty() ? 0 : Median(radii);
}

// The ways with all their shifts.
std::vector<Trial> MakeTrials(const SkeletonGraph& skeleton,
                              const std::vector<BranchContinuation>& ways, double step) {
  std::vector<Trial> trials;
  for (size_t i = 0; i < ways.size(); ++i) {
    const double radius = RadiusOf(skeleton, ways[i].branch);
    if (radius <= 0) continue;
    for (BranchContinuation& shifted : WithShifts(skeleton, ways[i])) {
      const EdgeId unknown = -1 - static_cast<EdgeId>(trials.size());
      trials.push_back({i, std::move(shifted), radius, {}, {}});
      trials.back().samples = SamplesAlong(trials.back().way.curve, unknown, step);
      trials.back().looks.resize(trials.back().samples.size());
    }
  }
  return trials;
}

// Of each way the trial that was seen most often, if it looks like a wire.
std::vector<BranchContinuation> Wires(const std::vector<Trial>& trials, size_t ways,
                                      const WireCompletionOptions& options) {
  std::vector<const Trial*> best(ways, nullptr);
  for (const Trial& trial : trials) {
    if (!IsWire(trial.looks, options)) continue;
    const Trial*& so_far = best[trial.index];
    if (so_far == nullptr || SeenShare(trial.looks) > SeenShare(so_far->looks)) so_far = &trial;
  }
  std::vector<BranchContinuation> wires;
  for (const Trial* trial : best) {
    if (trial != nullptr) wires.push_back(trial->way);
  }
  return wires;
}

}  // namespace

void VisitOptions(WireCompletionOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"enabled", "", 0, 1,
                 "Deviation: where a wire ends at another it is looked for beyond in the colour "
                 "images, which show wires along the line of sight that depth has lost."},
                options.enabled);
  visitor.Visit({"max_frames", "frames", 1, 1000000,
                 "Deviation: colour images that are looked at; more are thinned evenly."},
                options.max_frames);
  visitor.Visit({"rounds", "", 1, 100, "Deviation: how often what was found may be continued."},
                options.rounds);
  visitor.Visit({"step", "m", 0.0005, 0.05, "Deviation: distance of the places looked at."},
                options.step);
  visitor.Visit({"search_px", "px", 1, 50,
                 "Deviation: how far beside its expected place a strip is looked for."},
                options.search_px);
  visitor.Visit({"max_offset_px", "px", 0.5, 50,
                 "Deviation: a strip farther away from its expected place is none of the wire."},
                options.max_offset_px);
  visitor.Visit({"min_looks", "", 1, 1000,
                 "Deviation: places clear of other curves in fewer images say nothing."},
                options.min_looks);
  visitor.Visit({"min_share", "", 0, 1,
                 "Deviation: a place is wire where a strip is seen in so many of the images in "
                 "which it is clear."},
                options.min_share);
  visitor.Visit({"min_seen", "", 1, 100000,
                 "Deviation: strips seen along a way, in all images together, that it takes."},
                options.min_seen);
  visitor.Visit(
      {"min_places", "", 0, 1, "Deviation: a way is wire where so many of its places are."},
      options.min_places);
  VisitOptions(options.continuations, visitor);
}

CompletedWires CompleteWires(const SkeletonGraph& skeleton, const Sequence& sequence,
                             const WireCompletionOptions& options) {
  CompletedWires result{skeleton, 0, 0};
  auto ways = FindContinuations(skeleton, options.continuations);
  if (ways.empty()) return result;
  const WireImages images(skeleton, sequence, options);
  for (int round = 0; round < options.rounds; ++round) {
    std::vector<Trial> trials = MakeTrials(result.skeleton, ways, options.step);
    images.Look(SampleStrips(result.skeleton, options.step), trials);
    const auto wires = Wires(trials, ways.size(), options);
    result.rejected = static_cast<int>(ways.size() - wires.size());
    if (wires.empty()) break;
    result.added += static_cast<int>(wires.size());
    AddContinuations(result.skeleton, wires, options.continuations);
    ways = FindContinuations(result.skeleton, options.continuations);
  }
  return result;
}

}  // namespace curvefusion
