#include "fusion/best/best_pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "fusion/best/best_plan.h"
#include "fusion/best/colour_fit.h"
#include "fusion/best/colour_stages.h"
#include "fusion/best/contraction_space.h"
#include "fusion/best/weak_colour.h"
#include "fusion/registration/axis_correction.h"
#include "fusion/registration/bundle_ridges.h"
#include "fusion/registration/close_wires.h"
#include "fusion/registration/frame_points.h"
#include "fusion/registration/ray_noise.h"
#include "fusion/stage_progress.h"
#include "fusion/stage_reporter.h"
#include "fusion/volume/volume_fusion.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Bundles segmented at the same time, at most: much of a bundle is done one step after the other.
constexpr size_t kBundlesAtOnce = 4;
// What frames saw takes up to 110 MB: all points of the first 100 to 400 frames.
constexpr size_t kMaxFramePoints = 2'000'000;

// "Removing large surfaces" needs a model of them: all frames in one volume.
TsdfVolume FuseVolumeOfRun(const Sequence& sequence, const BestOptions& options,
                           const StageReporter& reporter) {
  const StageLog::Timer timer(reporter.log, "volume");
  const int stride = options.volume_stride;
  const int64_t frames = (sequence.frame_count() + stride - 1) / stride;
  StageProgress progress(reporter.observer, "volume", frames);
  TsdfVolume volume =
      FuseVolume(sequence, options.volume, stride, [&progress] { progress.Advance(); });
  reporter.observer.OnVolume(volume);
  reporter.log.Count("volume", "frames", static_cast<double>(frames));
  reporter.log.Count("volume", "blocks", static_cast<double>(volume.block_count()));
  reporter.log.Count("volume", "bytes", static_cast<double>(volume.memory_bytes()));
  return volume;
}

// What was found thin, in the world frame.
struct SegmentedScan {
  std::vector<ObservedPoints> bundles;
  FramePoints frames{kMaxFramePoints};  // what each frame saw of its bundle's points
  std::vector<int> bundle_of_frame;
  double points = 0;  // of all bundles
  PointFunnel funnel;
};

void AddBundle(const SegmentedBundle& bundle, SegmentedScan& scan, PipelineObserver& observer) {
  const std::string name = fmt::format("bundle_{:03}", scan.bundles.size());
  observer.OnPoints(name + "_difference_set",
                    Transformed(bundle.difference_set, bundle.T_world_bundle));
  for (const ObservedPoints& frame : bundle.frames) {
    scan.frames.Add(Transformed(frame, bundle.T_world_bundle));
    scan.bundle_of_frame.push_back(static_cast<int>(scan.bundles.size()));
  }
  scan.points += static_cast<double>(bundle.points.size());
  scan.funnel.Add(bundle.funnel);
  scan.bundles.push_back(Transformed(bundle.points, bundle.T_world_bundle));
  observer.OnPoints(name + "_points", scan.bundles.back());
}

SegmentationModel LearnSegmentationOfRun(const Sequence& sequence, const TsdfVolume& volume,
                                         const SegmentationOptions& options,
                                         const StageReporter& reporter) {
  const StageLog::Timer timer(reporter.log, "segmentation");
  reporter.observer.OnProgress("surfaces and colours", 0, 1);
  SegmentationModel model = LearnSegmentation(sequence, volume, options);
  reporter.log.Count("segmentation", "spacing in wire arrays, mm",
                     model.array_spacing / kMillimetre);
  reporter.log.Count("segmentation", "frame stride", model.frame_stride);
  return model;
}

using FrameRanges = std::vector<std::pair<int, int>>;

int64_t FramesToSegment(const FrameRanges& ranges, int frame_stride) {
  int64_t frames = 0;
  for (const auto& [first, last] : ranges)
    frames += (last - first + frame_stride - 1) / frame_stride;
  return frames;
}

SegmentedScan SegmentBundles(const Sequence& sequence, const TsdfVolume& volume,
                             const SegmentationModel& model, const BestOptions& options,
                             const StageReporter& reporter) {
  const StageLog::Timer timer(reporter.log, "segmentation");
  const FrameRanges ranges =
      SplitIntoBundles(sequence.frame_count(), options.segmentation.bundle.frames);
  StageProgress progress(reporter.observer, "segmentation",
                         FramesToSegment(ranges, model.frame_stride));
  SegmentedScan scan;
  // About as many each time, so that no bundle is left to itself in the end.
  const size_t times = (ranges.size() + kBundlesAtOnce - 1) / kBundlesAtOnce;
  size_t candidates = 0, begin = 0;
  for (size_t left = times; left > 0; --left) {
    std::vector<SegmentedBundle> bundles((ranges.size() - begin + left - 1) / left);
    ParallelFor(0, static_cast<int64_t>(bundles.size()), 1, [&](int64_t i) {
      const auto& [first, last] = ranges[begin + static_cast<size_t>(i)];
      bundles[i] = SegmentBundle(sequence, first, last, volume, model, options.segmentation,
                                 [&progress] { progress.Advance(); });
    });
    for (const SegmentedBundle& bundle : bundles) {
      candidates += bundle.difference_set.size();
      AddBundle(bundle, scan, reporter.observer);
    }
    begin += bundles.size();
    // As if the rest held as many.
    const double points = scan.points * sequence.frame_count() / ranges[begin - 1].second;
    reporter.observer.OnPlan(PlanBest(sequence, options, {.points = points}));
  }
  reporter.log.Count("segmentation", "bundles", static_cast<double>(scan.bundles.size()));
  reporter.log.Count("segmentation", "candidates", static_cast<double>(candidates));
  reporter.log.Count("segmentation", "points", scan.points);
  reporter.log.Count("segmentation", "frame point stride",
                     static_cast<double>(scan.frames.stride()));
  return scan;
}

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
RegisteredBundles RegisterBundles(const SegmentedScan& scan, double array_spacing,
                                  const RidgeProjectionOptions& ridges, const BestOptions& options,
                                  const StageReporter& reporter) {
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
                                                 array_spacing)
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
void ContractCarriedPoints(SegmentedScan scan, const SegmentationModel& model,
                           const BestOptions& options, const StageReporter& reporter,
                           Reconstruction& result) {
  const ContractionSpace space = {Magnification(model.array_spacing, options.resolved_spacing),
                                  RayNoiseRatio(LargestBundle(scan), options.min_linearity)};
  const RidgeProjectionOptions ridges =
      ForCloseWires(options.ridge.projection, space.magnification);
  const RegisteredBundles bundles =
      RegisterBundles(scan, model.array_spacing, ridges, options, reporter);
  scan.bundles.clear();
  SkeletonGraph first =
      Contract(bundles.points, bundles.ridge, "registered_bundles", space, options.ridge, reporter);
  RunSize size = {.points = scan.points};
  size.SetCurves(first);
  reporter.observer.OnPlan(PlanBest(result.sequence, options, size));
  AssignRadii(MeasureRadii(first, result.sequence, model.array_diameter, options.radius, reporter),
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

// Everything after the volume.
Reconstruction ReconstructThinParts(const TsdfVolume& volume, const Sequence& sequence,
                                    const BestOptions& options, const StageReporter& reporter) {
  Reconstruction result;
  result.sequence = sequence;
  result.warnings = sequence.warnings;
  const SegmentationModel model =
      LearnSegmentationOfRun(sequence, volume, options.segmentation, reporter);
  SegmentedScan scan = SegmentBundles(sequence, volume, model, options, reporter);
  const RunSize size = {.points = scan.points};
  result.funnel.points = scan.funnel;
  ContractCarriedPoints(std::move(scan), model, options, reporter, result);
  result.funnel.curves.contracted = result.skeleton.TotalLength();
  RefineByColour(sequence, model, size, options, reporter, result);
  result.funnel.curves.curves = result.skeleton.TotalLength();
  result.trust = MeasureTrust(sequence, result);
  const std::string places = PlacesWarning(result.trust);
  if (options.colour_adjustment.enabled && !places.empty()) result.warnings.push_back(places);
  result.stages = reporter.log.stages();
  return result;
}

}  // namespace

Reconstruction ReconstructBest(const Sequence& sequence, const BestOptions& given,
                               PipelineObserver& observer) {
  BestOptions options = given;
  const std::string useless_colour = SwitchOffUselessColour(sequence, options);
  observer.OnPlan(PlanBest(sequence, options, {}));
  StageLog log;
  const StageReporter reporter{observer, log};
  const TsdfVolume volume = FuseVolumeOfRun(sequence, options, reporter);
  Reconstruction result = ReconstructThinParts(volume, sequence, options, reporter);
  if (!useless_colour.empty()) result.warnings.push_back(useless_colour);
  return result;
}

Reconstruction ReconstructBestAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                      const BestOptions& options, PipelineObserver& observer) {
  observer.OnPlan(PlanBest(sequence, options, {}));
  StageLog log;
  return ReconstructThinParts(volume, sequence, options, StageReporter{observer, log});
}

}  // namespace curvefusion
