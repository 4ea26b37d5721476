#include "fusion/best/best_pipeline.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "capture/content/geometry_check.h"
#include "capture/frame_stream.h"
#include "fusion/best/best_plan.h"
#include "fusion/best/colour_fit.h"
#include "fusion/best/colour_stages.h"
#include "fusion/best/contraction_space.h"
#include "fusion/best/measure_trust.h"
#include "fusion/best/scale_of_poses.h"
#include "fusion/best/weak_colour.h"
#include "fusion/best/world_scale.h"
#include "fusion/registration/axis_correction.h"
#include "fusion/registration/close_wires.h"
#include "fusion/registration/frame_points.h"
#include "fusion/registration/ray_noise.h"
#include "fusion/stage_progress.h"
#include "fusion/tracking/tracked_poses.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// GainOfDepth, near. Chosen: less is chance. A real cable has 1.01 and is lost with its held poses,
// a real kitchen 1.11 and gives edges without.
constexpr double kLeastGain = 1.05;
// Poses that are some pixels off are put right by the colour images themselves, to less than depth
// knows. Chosen on 21 training scans, the four shared ones and two recordings, which therefore do
// not test it: those that did not gain had 1.0 to 1.5, those that gained most 1.6 to 5.2
// (docs/lab_notebook.md).
constexpr double kMinGain = 1.5;
// Where poses jump once, hardly any frames near each other tell. Chosen between scans that hardly
// gain near by, with .9 to 2.3, and shared ones with a jump of 16 mm, with 3.5 to 5.6.
constexpr double kMinFarGain = 2.8;

// `ridge` holds the ridges of the points where they are known already.
SkeletonGraph Contract(const ObservedPoints& points, const std::optional<RidgePoints>& ridge,
                       const std::string& name, const ContractionSpace& space,
                       const RidgeOptions& options, const StageReporter& reporter) {
  const StageLog::Timer timer = reporter.Begin("contraction");
  SkeletonGraph skeleton = ContractIn(space, points, ridge, options);
  reporter.log.Count("contraction", "ray noise ratio", space.ray_noise_ratio);
  reporter.observer.OnPoints(name + "_points", points);
  reporter.observer.OnGraph(name + "_skeleton", skeleton);
  return skeleton;
}

struct RegisteredBundles {
  ObservedPoints points;                           // of all bundles
  RidgePoints ridge;                               // of the points
  std::vector<RigidTransform> T_registered_frame;  // for every frame how its bundle was moved
};

// Registers every bundle to the curves of those before it.
RegisteredBundles RegisterBundles(const SegmentedScan& scan, const RidgeProjectionOptions& ridges,
                                  const BestOptions& options, const StageReporter& reporter) {
  const StageLog::Timer timer(reporter.log, "registration");
  StageProgress progress(reporter.observer, "bundle registration",
                         static_cast<int64_t>(scan.bundles.size()));
  CarriedPoints carried(options.carried);
  const RidgeProjectionOptions coarse = ForBundles(ridges);
  // Side by side, as much of a projection is done one step after the other.
  std::vector<RidgePoints> ridge_of_bundle(scan.bundles.size());
  ParallelFor(0, static_cast<int64_t>(scan.bundles.size()), 1,
              [&](int64_t i) { ridge_of_bundle[i] = ProjectToRidges(scan.bundles[i], coarse); });
  std::vector<RigidTransform> T_registered_bundle;
  for (size_t i = 0; i < scan.bundles.size(); ++i) {
    T_registered_bundle.push_back(carried
                                      .AddBundle(scan.bundles[i], ridge_of_bundle[i],
                                                 ridges.spacing, options.registration,
                                                 scan.wires.array_spacing)
                                      .T_target_source);
    progress.Advance();
  }
  std::vector<RigidTransform> T_registered_frame;
  for (const int bundle : scan.bundle_of_frame) {
    T_registered_frame.push_back(T_registered_bundle[bundle]);
  }
  return {carried.points(), FollowRidges(carried.points(), carried.ridges(), ridges),
          T_registered_frame};
}

// Registers single frames, whose points are moved to the axes of a first skeleton.
RegisteredFrames RegisterFramesToCurves(std::vector<ObservedPoints> frames,
                                        const RegisteredBundles& bundles,
                                        const std::vector<Vec3>& cameras,
                                        const SkeletonGraph& first,
                                        const RidgeProjectionOptions& ridges,
                                        const BestOptions& options, const StageReporter& reporter) {
  const StageLog::Timer timer(reporter.log, "registration");
  reporter.observer.OnProgress("frame registration", 0, 1);
  const AxisCorrection correction(first, options.axis_depth);
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    const RigidTransform& T = bundles.T_registered_frame[i];
    frames[i] = Transformed(correction.Apply(Transformed(frames[i], T)), T.inverse());
  });
  RegisteredFrames registered =
      RegisterFrames(frames, bundles.T_registered_frame, cameras, bundles.ridge, ridges,
                     options.registration, options.frames);
  reporter.log.Count("registration", "registered frames", registered.registered);
  reporter.log.Count("registration", "points", static_cast<double>(registered.points.size()));
  return registered;
}

std::vector<Vec3> CameraCenters(const Sequence& sequence) {
  std::vector<Vec3> centers;
  for (const SequenceFrame& frame : sequence.frames) {
    centers.push_back(frame.T_world_camera.translation());
  }
  return centers;
}

void CorrectPoses(const std::vector<RigidTransform>& T_registered_world, Sequence& sequence) {
  for (size_t i = 0; i < sequence.frames.size(); ++i) {
    RigidTransform& T_world_camera = sequence.frames[i].T_world_camera;
    T_world_camera = T_registered_world[i] * T_world_camera;
  }
}

// Noise blurs the points of a single bundle, drift only those of several together.
ObservedPoints LargestBundle(const SegmentedScan& scan) {
  const auto largest =
      std::max_element(scan.bundles.begin(), scan.bundles.end(),
                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return largest == scan.bundles.end() ? ObservedPoints{} : *largest;
}

// Bundles, then single frames, are registered to the curves they see; their points
// are carried along and contracted once. Where noise blurs the curves, single frames would be
// registered to noise: they keep the poses of their bundles.
void ContractCarriedPoints(SegmentedScan scan, const BestOptions& options,
                           const StageReporter& reporter, Reconstruction& result) {
  // Nets are sought only where there are no arrays.
  const double spacing = std::max(scan.wires.array_spacing, scan.wires.nets.spacing);
  const ContractionSpace space = {Magnification(spacing, options.resolved_spacing),
                                  RayNoiseRatio(LargestBundle(scan), options.min_linearity)};
  const RidgeProjectionOptions ridges =
      ForCloseWires(options.ridge.projection, space.magnification);
  const RegisteredBundles bundles = RegisterBundles(scan, ridges, options, reporter);
  scan.bundles.clear();
  SkeletonGraph first =
      Contract(bundles.points, bundles.ridge, "registered_bundles", space, options.ridge, reporter);
  RunSize size = {.points = scan.points};
  size.SetCurves(first);
  reporter.observer.OnPlan(PlanBest(result.sequence, options, size));
  AssignRadii(
      MeasureRadii(first, result.sequence, scan.wires.array_diameter, options.radius, reporter),
      first);
  if (space.ray_noise_ratio > 1) {
    CorrectPoses(bundles.T_registered_frame, result.sequence);
    result.points = AxisCorrection(first, options.axis_depth).Apply(bundles.points);
  } else {
    RegisteredFrames registered =
        RegisterFramesToCurves(std::move(scan.frames).Release(), bundles,
                               CameraCenters(result.sequence), first, ridges, options, reporter);
    CorrectPoses(registered.T_registered_world, result.sequence);
    result.points = std::move(registered.points);
  }
  // Whatever shows only now that all points are in place is to be found, too.
  result.skeleton =
      Contract(result.points, std::nullopt, "registered_frames", space, options.ridge, reporter);
}

// With poses that fit the surfaces behind the wires, which all frames see, where depth shows any:
// some frames tell whether such poses are better.
PosedScan HoldToSurfaces(const Sequence& given, const BestOptions& options,
                         const StageReporter& reporter) {
  if (!given.has_depth || !options.depth.hold_to_surfaces) return {given, given};
  const char* stage = "hold to surfaces";
  const auto hold = [&given, reporter, stage](const std::vector<int>& frames) {
    const StageLog::Timer timer = reporter.Begin(stage);
    return HeldToItsSurfaces(given, frames,
                             [&](std::string_view name, int64_t done, int64_t total) {
                               reporter.observer.OnProgress(std::string(name), done, total);
                             });
  };
  const auto hold_all = [&given, hold] { return hold(AllFrames(given)); };
  reporter.log.Count(stage, "frames moved", 0);
  const std::optional<DepthGain> gain = GainOfDepth(given, hold(FramesOfGain(given)));
  if (!gain || gain->near < kLeastGain) return {given, given};
  if (gain->near < kMinGain && gain->far < kMinFarGain) {
    return {given, given, PoseErrors::kDrift, hold_all};
  }
  reporter.log.Count(stage, "frames moved", given.frame_count());
  reporter.observer.OnPlan(PlanBest(given, options, {.holds_poses = true}));
  return {given, hold_all(), PoseErrors::kJitter};
}

// What colour images make of curves, and how far the result may be trusted.
void RefineAndJudge(const PosedScan& scan, const LearnedWires& wires, RunSize size,
                    const BestOptions& options, const StageReporter& reporter,
                    Reconstruction& result) {
  RefineByColour(scan, wires, size, options, reporter, result);
  // No adjustment to colour images alone knows its scale.
  if (result.trust.from_colour && scan.given.has_depth) HoldToScaleOfDepth(result);
  if (result.trust.from_colour && !scan.given.has_depth) HoldToScaleOf(scan.given, result);
  result.funnel.curves.curves = result.skeleton.TotalLength();
  result.trust = MeasureTrust(scan.given, result);
  const std::string places = PlacesWarning(result.trust);
  if (options.colour_adjustment.enabled && !places.empty()) result.warnings.push_back(places);
  const std::string view = ViewWarning(result.trust);
  if (!view.empty()) result.warnings.push_back(view);
  result.stages = reporter.log.stages();
}

// From colour images and poses.
Reconstruction ReconstructWithoutDepth(const PosedScan& scan, const BestOptions& options,
                                       const StageReporter& reporter) {
  Reconstruction result;
  result.sequence = scan.sequence;
  result.warnings = scan.sequence.warnings;
  RefineAndJudge(scan, {}, {.by_colour = true}, options, reporter, result);
  return result;
}

// What is thin, then all that is made of it.
Reconstruction ReconstructThinParts(const BundleSource& source, const PosedScan& scan,
                                    const BestOptions& options, const StageReporter& reporter) {
  Reconstruction result;
  result.sequence = scan.sequence;
  result.warnings = scan.sequence.warnings;
  SegmentedScan thin = GatherBundles(source, scan.sequence, options, reporter);
  const LearnedWires wires = thin.wires;
  const RunSize size = {.points = thin.points};
  result.funnel.points = thin.funnel;
  ContractCarriedPoints(std::move(thin), options, reporter, result);
  result.funnel.curves.contracted = result.skeleton.TotalLength();
  RefineAndJudge(scan, wires, size, options, reporter, result);
  return result;
}

// What both runs of a stage took.
void AddTimes(const std::vector<StageReport>& before, std::vector<StageReport>& stages) {
  for (StageReport& stage : stages) {
    for (const StageReport& same : before) {
      if (same.name == stage.name) stage.seconds += same.seconds;
    }
  }
}

// Once more in a larger world, where wires are much thinner than those that lengths were chosen on.
Reconstruction AtScaleOfWires(Reconstruction found, const Sequence& given,
                              const BestOptions& options, PipelineObserver& observer) {
  if (!options.depth.magnify_fine_wires) return found;
  const std::optional<double> magnification = MagnificationFor(found);
  if (!magnification) return found;
  observer.OnProgress("magnification", 0, 1);
  BestOptions once = options;
  once.depth.magnify_fine_wires = false;
  ReducingObserver reducing(observer, *magnification);
  Reconstruction magnified = ReconstructBest(Magnified(given, *magnification), once, reducing);
  if (magnified.skeleton.empty()) return found;
  AddTimes(found.stages, magnified.stages);
  magnified.stages.push_back({"magnification", 0, 0, {{"times", *magnification}}, {}});
  return Reduced(std::move(magnified), *magnification, given);
}

void CountVolume(const VolumeFigures& figures, StageLog& log) {
  log.Count("volume", "frames", static_cast<double>(figures.frames));
  log.Count("volume", "blocks", static_cast<double>(figures.blocks));
  log.Count("volume", "bytes", static_cast<double>(figures.bytes));
}

// The sink, and the figures of the volume into the log.
BundleSink CountingVolume(const BundleSink& sink, StageLog& log) {
  return {[&](const LearnedScan& learned) {
            CountVolume(learned.volume, log);
            sink.on_learned(learned);
          },
          sink.on_bundle};
}

}  // namespace

Reconstruction ReconstructBest(const Sequence& all, const BestOptions& given_options,
                               PipelineObserver& observer) {
  BestOptions options = given_options;
  const bool is_used = all.has_depth && options.depth.use != DepthRole::kNone;
  const Sequence given = is_used ? all : WithoutDepth(all);
  const std::string useless_colour = SwitchOffUselessColour(given, options);
  observer.OnPlan(PlanBest(given, options, {}));
  StageLog log;
  const StageReporter reporter{observer, log};
  const PosedScan scan = HoldToSurfaces(given, options, reporter);
  const BundleSource source = [&](const BundleSink& sink) {
    const TsdfVolume volume = FuseVolumeOfRun(scan.sequence, options, reporter);
    SegmentBundles(scan.sequence, volume, AllBundles(given, options), options, reporter,
                   CountingVolume(sink, log));
  };
  Reconstruction result = is_used ? ReconstructThinParts(source, scan, options, reporter)
                                  : ReconstructWithoutDepth(scan, options, reporter);
  if (!useless_colour.empty()) result.warnings.push_back(useless_colour);
  return AtScaleOfWires(std::move(result), all, given_options, observer);
}

Reconstruction ReconstructBestAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                      const BestOptions& options, PipelineObserver& observer) {
  observer.OnPlan(PlanBest(sequence, options, {}));
  StageLog log;
  const StageReporter reporter{observer, log};
  const BundleSource source = [&](const BundleSink& sink) {
    SegmentBundles(sequence, volume, AllBundles(sequence, options), options, reporter, sink);
  };
  return ReconstructThinParts(source, {sequence, sequence}, options, reporter);
}

void SegmentBest(const Sequence& given_sequence, const BestOptions& given, BundleRange range,
                 const BundleSink& sink, PipelineObserver& observer) {
  BestOptions options = given;
  SwitchOffUselessColour(given_sequence, options);
  const double share =
      static_cast<double>(range.last - range.first) / AllBundles(given_sequence, options).last;
  observer.OnPlan(PlanSegmentation(given_sequence, options, share));
  StageLog log;
  const StageReporter reporter{observer, log};
  const Sequence sequence = HoldToSurfaces(given_sequence, options, reporter).sequence;
  const TsdfVolume volume = FuseVolumeOfRun(sequence, options, reporter);
  SegmentBundles(sequence, volume, range, options, reporter, sink);
}

Reconstruction ReconstructBestFrom(const BundleSource& shards, const Sequence& sequence,
                                   const BestOptions& given, PipelineObserver& observer,
                                   bool fuse_volume) {
  BestOptions options = given;
  const std::string useless_colour = SwitchOffUselessColour(sequence, options);
  observer.OnPlan(PlanBest(sequence, options, {}));
  StageLog log;
  const StageReporter reporter{observer, log};
  const PosedScan scan = HoldToSurfaces(sequence, options, reporter);
  if (fuse_volume) FuseVolumeOfRun(scan.sequence, options, reporter);
  const BundleSource source = [&](const BundleSink& sink) {
    const StageLog::Timer timer = reporter.Begin("segmentation");
    shards(CountingVolume(sink, log));
  };
  Reconstruction result = ReconstructThinParts(source, scan, options, reporter);
  if (!useless_colour.empty()) result.warnings.push_back(useless_colour);
  return AtScaleOfWires(std::move(result), sequence, given, observer);
}

}  // namespace curvefusion
