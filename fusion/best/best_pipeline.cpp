#include "fusion/best/best_pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "fusion/best/best_plan.h"
#include "fusion/best/colour_stages.h"
#include "fusion/best/run_context.h"
#include "fusion/best/weak_colour.h"
#include "fusion/registration/axis_correction.h"
#include "fusion/registration/close_wires.h"
#include "fusion/registration/frame_points.h"
#include "fusion/registration/ray_noise.h"
#include "fusion/stage_progress.h"
#include "fusion/volume/volume_fusion.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Bundles segmented at the same time, at most: much of a bundle is done one step after the other.
constexpr size_t kBundlesAtOnce = 4;
// Ridge points by which a bundle is registered are so many times as far apart as those of curves.
constexpr double kBundleSpacing = 1.5;
// What frames saw takes up to 110 MB: all points of the first 100 to 400 frames.
constexpr size_t kMaxFramePoints = 2'000'000;

// "Removing large surfaces" needs a model of them: all frames in one volume.
TsdfVolume FuseVolumeOfRun(const Sequence& sequence, RunContext& run) {
  const StageLog::Timer timer(run.log, "volume");
  const int stride = run.options.volume_stride;
  const int64_t frames = (sequence.frame_count() + stride - 1) / stride;
  StageProgress progress(run.observer, "volume", frames);
  TsdfVolume volume =
      FuseVolume(sequence, run.options.volume, stride, [&progress] { progress.Advance(); });
  run.observer.OnVolume(volume);
  run.log.Count("volume", "frames", static_cast<double>(frames));
  run.log.Count("volume", "blocks", static_cast<double>(volume.block_count()));
  run.log.Count("volume", "bytes", static_cast<double>(volume.memory_bytes()));
  return volume;
}

// What was found thin, in the world frame.
struct SegmentedScan {
  std::vector<ObservedPoints> bundles;
  FramePoints frames{kMaxFramePoints};  // what each frame saw of its bundle's points
  std::vector<int> bundle_of_frame;
};

void AddBundle(const SegmentedBundle& bundle, SegmentedScan& scan, PipelineObserver& observer) {
  const std::string name = fmt::format("bundle_{:03}", scan.bundles.size());
  observer.OnPoints(name + "_difference_set",
                    Transformed(bundle.difference_set, bundle.T_world_bundle));
  for (const ObservedPoints& frame : bundle.frames) {
    scan.frames.Add(Transformed(frame, bundle.T_world_bundle));
    scan.bundle_of_frame.push_back(static_cast<int>(scan.bundles.size()));
  }
  scan.bundles.push_back(Transformed(bundle.points, bundle.T_world_bundle));
  observer.OnPoints(name + "_points", scan.bundles.back());
}

SegmentedScan SegmentBundles(const Sequence& sequence, const TsdfVolume& volume, RunContext& run) {
  const StageLog::Timer timer(run.log, "segmentation");
  SegmentedScan scan;
  run.observer.OnProgress("surfaces and colours", 0, 1);
  const SegmentationModel model = LearnSegmentation(sequence, volume, run.options.segmentation);
  run.row_spacing = model.row_spacing;
  run.row_diameter = model.row_diameter;
  run.colours = model.colours;
  run.magnification = Magnification(model.row_spacing, run.options.resolved_spacing);
  run.log.Count("segmentation", "row spacing, mm", model.row_spacing / kMillimetre);
  run.log.Count("segmentation", "frame stride", model.frame_stride);
  const auto ranges =
      SplitIntoBundles(sequence.frame_count(), run.options.segmentation.bundle.frames);
  int64_t frames = 0;
  for (const auto& [first, last] : ranges) {
    frames += (last - first + model.frame_stride - 1) / model.frame_stride;
  }
  StageProgress progress(run.observer, "segmentation", frames);
  // About as many each time, so that no bundle is left to itself in the end.
  const size_t times = (ranges.size() + kBundlesAtOnce - 1) / kBundlesAtOnce;
  size_t candidates = 0, points = 0, begin = 0;
  for (size_t left = times; left > 0; --left) {
    std::vector<SegmentedBundle> bundles((ranges.size() - begin + left - 1) / left);
    ParallelFor(0, static_cast<int64_t>(bundles.size()), 1, [&](int64_t i) {
      const auto& [first, last] = ranges[begin + static_cast<size_t>(i)];
      bundles[i] = SegmentBundle(sequence, first, last, volume, model, run.options.segmentation,
                                 [&progress] { progress.Advance(); });
    });
    for (const SegmentedBundle& bundle : bundles) {
      candidates += bundle.difference_set.size();
      points += bundle.points.size();
      run.funnel.points.Add(bundle.funnel);
      AddBundle(bundle, scan, run.observer);
    }
    begin += bundles.size();
    // As if the rest held as many.
    run.size.points =
        static_cast<double>(points) * sequence.frame_count() / ranges[begin - 1].second;
    run.observer.OnPlan(PlanBest(sequence, run.options, run.size));
  }
  run.log.Count("segmentation", "bundles", static_cast<double>(scan.bundles.size()));
  run.log.Count("segmentation", "candidates", static_cast<double>(candidates));
  run.log.Count("segmentation", "points", static_cast<double>(points));
  run.log.Count("segmentation", "frame point stride", static_cast<double>(scan.frames.stride()));
  return scan;
}

// `ridge` holds the ridges of the points where they are known already.
SkeletonGraph Contract(const ObservedPoints& points, const std::optional<RidgePoints>& ridge,
                       const std::string& name, RunContext& run) {
  const StageLog::Timer timer(run.log, "contraction");
  run.observer.OnProgress("contraction", 0, 1);
  const double ratio = run.ray_noise_ratio;
  const AffineTransform T_space_world =
      ratio > 1 ? NoiseMetric(points, ratio) : AffineTransform(Eigen::Scaling(run.magnification));
  SkeletonGraph skeleton;
  if (ratio > 1 || run.magnification > 1) {
    skeleton = ExtractRidgeSkeleton(points, run.options.ridge, T_space_world);
  } else if (ridge) {
    skeleton = ExtractRidgeSkeleton(points, *ridge, run.options.ridge);
  } else {
    skeleton = ExtractRidgeSkeleton(points, run.options.ridge);
  }
  run.log.Count("contraction", "ray noise ratio", ratio);
  run.observer.OnPoints(name + "_points", points);
  run.observer.OnGraph(name + "_skeleton", skeleton);
  return skeleton;
}

struct RegisteredBundles {
  ObservedPoints points;                           // of all bundles
  RidgePoints ridge;                               // of the points
  std::vector<RigidTransform> T_registered_frame;  // for every frame how its bundle was moved
};

// Registers every bundle to the curves of those before it.
RegisteredBundles RegisterBundles(const SegmentedScan& scan, RunContext& run) {
  const StageLog::Timer timer(run.log, "registration");
  StageProgress progress(run.observer, "bundle registration",
                         static_cast<int64_t>(scan.bundles.size()));
  CarriedPoints carried(run.options.carried);
  const RidgeProjectionOptions ridges =
      ForCloseWires(run.options.ridge.projection, run.magnification);
  RidgeProjectionOptions coarse = ridges;
  coarse.spacing *= kBundleSpacing;
  // Side by side, as much of a projection is done one step after the other.
  std::vector<RidgePoints> ridge_of_bundle(scan.bundles.size());
  ParallelFor(0, static_cast<int64_t>(scan.bundles.size()), 1,
              [&](int64_t i) { ridge_of_bundle[i] = ProjectToRidges(scan.bundles[i], coarse); });
  std::vector<RigidTransform> T_registered_bundle;
  for (size_t i = 0; i < scan.bundles.size(); ++i) {
    T_registered_bundle.push_back(carried
                                      .AddBundle(scan.bundles[i], ridge_of_bundle[i],
                                                 ridges.spacing, run.options.registration,
                                                 run.row_spacing)
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
                                        const SkeletonGraph& first, RunContext& run) {
  const StageLog::Timer timer(run.log, "registration");
  run.observer.OnProgress("frame registration", 0, 1);
  const AxisCorrection correction(first, run.options.axis_depth);
  ParallelFor(0, static_cast<int64_t>(frames.size()), 1, [&](int64_t i) {
    const RigidTransform& T = bundles.T_registered_frame[i];
    frames[i] = Transformed(correction.Apply(Transformed(frames[i], T)), T.inverse());
  });
  RegisteredFrames registered =
      RegisterFrames(frames, bundles.T_registered_frame, cameras, bundles.ridge,
                     ForCloseWires(run.options.ridge.projection, run.magnification),
                     run.options.registration, run.options.frames);
  run.log.Count("registration", "registered frames", registered.registered);
  run.log.Count("registration", "points", static_cast<double>(registered.points.size()));
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
void ContractCarriedPoints(SegmentedScan scan, RunContext& run, Reconstruction& result) {
  run.ray_noise_ratio = RayNoiseRatio(LargestBundle(scan), run.options.min_linearity);
  const RegisteredBundles bundles = RegisterBundles(scan, run);
  scan.bundles.clear();
  SkeletonGraph first = Contract(bundles.points, bundles.ridge, "registered_bundles", run);
  run.size.length = first.TotalLength();
  run.observer.OnPlan(PlanBest(result.sequence, run.options, run.size));
  AssignRadii(MeasureRadii(first, result.sequence, run), run.options.radius, first);
  if (run.ray_noise_ratio > 1) {
    CorrectPoses(bundles.T_registered_frame, result.sequence);
    result.points = AxisCorrection(first, run.options.axis_depth).Apply(bundles.points);
  } else {
    RegisteredFrames registered = RegisterFramesToCurves(
        std::move(scan.frames).Release(), bundles, CameraCenters(result.sequence), first, run);
    CorrectPoses(registered.T_registered_world, result.sequence);
    result.points = std::move(registered.points);
  }
  // Whatever shows only now that all points are in place is to be found, too.
  result.skeleton = Contract(result.points, std::nullopt, "registered_frames", run);
}

// Everything after the volume.
Reconstruction ReconstructThinParts(const TsdfVolume& volume, const Sequence& sequence,
                                    RunContext& run) {
  Reconstruction result;
  result.sequence = sequence;
  result.warnings = sequence.warnings;
  SegmentedScan scan = SegmentBundles(sequence, volume, run);
  ContractCarriedPoints(std::move(scan), run, result);
  run.funnel.curves.contracted = result.skeleton.TotalLength();
  RefineByColour(sequence, run, result);
  run.funnel.curves.curves = result.skeleton.TotalLength();
  result.funnel = run.funnel;
  result.trust = MeasureTrust(sequence, result);
  result.stages = run.log.stages();
  return result;
}

}  // namespace

Reconstruction ReconstructBest(const Sequence& sequence, const BestOptions& given,
                               PipelineObserver& observer) {
  BestOptions options = given;
  const std::string useless_colour = SwitchOffUselessColour(sequence, options);
  RunContext run{options, observer, {}};
  observer.OnPlan(PlanBest(sequence, options, run.size));
  const TsdfVolume volume = FuseVolumeOfRun(sequence, run);
  Reconstruction result = ReconstructThinParts(volume, sequence, run);
  if (!useless_colour.empty()) result.warnings.push_back(useless_colour);
  return result;
}

Reconstruction ReconstructBestAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                      const BestOptions& options, PipelineObserver& observer) {
  RunContext run{options, observer, {}};
  observer.OnPlan(PlanBest(sequence, options, run.size));
  return ReconstructThinParts(volume, sequence, run);
}

}  // namespace curvefusion
