#include "fusion/pipeline.h"

#include <fmt/format.h>

#include <chrono>
#include <numeric>

#include "capture/frame_stream.h"

namespace curvefusion {

namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

ObservedPoints Moved(const ObservedPoints& points, const RigidTransform& T) {
  ObservedPoints moved = points;
  for (Vec3& p : moved.positions) p = T * p;
  for (Vec3& ray : moved.viewing_rays) ray = T.linear() * ray;
  return moved;
}

// "Removing large surfaces" needs a model of them: all frames in one volume.
TsdfVolume FuseVolume(const Sequence& sequence, const PipelineOptions& options,
                      PipelineObserver& observer, Reconstruction& result) {
  const Clock::time_point start = Clock::now();
  TsdfVolume volume(options.volume);
  std::vector<int> frames;
  for (int i = 0; i < sequence.frame_count(); i += options.volume_stride) frames.push_back(i);
  ForEachFrame(sequence, frames, {.depth = true, .color = false}, [&](const DecodedFrame& frame) {
    volume.Integrate(frame.depth, sequence.depth_camera,
                     sequence.frames[frame.index].T_world_camera);
    observer.OnProgress("volume", frame.index + 1, sequence.frame_count());
  });
  observer.OnVolume(volume);
  result.stages.push_back({"volume",
                           SecondsSince(start),
                           {{"frames", static_cast<double>(frames.size())},
                            {"blocks", static_cast<double>(volume.block_count())},
                            {"bytes", static_cast<double>(volume.memory_bytes())}}});
  return volume;
}

// The points of every bundle that belong to thin structures, in the world frame.
std::vector<ObservedPoints> SegmentBundles(const Sequence& sequence, const TsdfVolume& volume,
                                           const PipelineOptions& options,
                                           PipelineObserver& observer, Reconstruction& result) {
  const Clock::time_point start = Clock::now();
  std::vector<ObservedPoints> bundles;
  double candidates = 0, points = 0;
  for (const auto& [first, last] :
       SplitIntoBundles(sequence.frame_count(), options.segmentation.bundle.frames)) {
    const SegmentedBundle bundle =
        SegmentBundle(sequence, first, last, volume, options.segmentation);
    const std::string name = fmt::format("bundle_{:03}", bundles.size());
    observer.OnPoints(name + "_difference_set",
                      Moved(bundle.difference_set.points, bundle.T_world_bundle));
    bundles.push_back(Moved(bundle.points, bundle.T_world_bundle));
    observer.OnPoints(name + "_points", bundles.back());
    observer.OnProgress("segmentation", last, sequence.frame_count());
    candidates += static_cast<double>(bundle.difference_set.points.size());
    points += static_cast<double>(bundle.points.size());
  }
  result.stages.push_back({"segmentation",
                           SecondsSince(start),
                           {{"bundles", static_cast<double>(bundles.size())},
                            {"candidates", candidates},
                            {"points", points}}});
  return bundles;
}

// Best profile: every bundle is registered to the curves so far, its points are carried along, and
// all are contracted once.
ObservedPoints CarryPoints(const std::vector<ObservedPoints>& bundles,
                           const PipelineOptions& options, PipelineObserver& observer,
                           Reconstruction& result) {
  const Clock::time_point start = Clock::now();
  CarriedPoints carried(options.carried);
  int registered = 0;
  for (size_t i = 0; i < bundles.size(); ++i) {
    const AlignmentResult alignment =
        carried.AddBundle(bundles[i], options.ridge.projection, options.alignment);
    registered += alignment.converged;
    observer.OnProgress("registration", static_cast<int64_t>(i + 1),
                        static_cast<int64_t>(bundles.size()));
  }
  observer.OnPoints("carried_points", carried.points());
  result.stages.push_back({"registration",
                           SecondsSince(start),
                           {{"registered bundles", static_cast<double>(registered)},
                            {"points", static_cast<double>(carried.points().size())}}});
  return carried.points();
}

// Paper profile: a skeleton for every bundle, fused one after the other, CurveFusion 3.2 and 3.3.
SkeletonGraph FuseBundleSkeletons(const std::vector<ObservedPoints>& bundles,
                                  const PipelineOptions& options, PipelineObserver& observer,
                                  Reconstruction& result) {
  SkeletonGraph partial;
  double contraction_seconds = 0, fusion_seconds = 0;
  for (size_t i = 0; i < bundles.size(); ++i) {
    const Clock::time_point start = Clock::now();
    const SkeletonGraph bundle = ExtractL1Skeleton(bundles[i], options.l1);
    contraction_seconds += SecondsSince(start);
    const Clock::time_point fusion_start = Clock::now();
    partial = i == 0 ? SmoothGraph(bundle, options.fusion.smoothing)
                     : FuseSkeletons(partial, bundle, static_cast<int>(i), options.fusion);
    fusion_seconds += SecondsSince(fusion_start);
    observer.OnGraph(fmt::format("bundle_{:03}_skeleton", i), bundle);
    observer.OnGraph(fmt::format("bundle_{:03}_fused", i), partial);
    observer.OnProgress("skeletons", static_cast<int64_t>(i + 1),
                        static_cast<int64_t>(bundles.size()));
  }
  result.stages.push_back({"contraction", contraction_seconds, {}});
  result.stages.push_back(
      {"fusion", fusion_seconds, {{"edges", static_cast<double>(partial.edge_count())}}});
  return partial;
}

SkeletonGraph ContractOnce(const ObservedPoints& points, const PipelineOptions& options,
                           PipelineObserver& observer, Reconstruction& result) {
  const Clock::time_point start = Clock::now();
  SkeletonGraph skeleton = ExtractRidgeSkeleton(points, options.ridge);
  observer.OnGraph("contracted", skeleton);
  result.stages.push_back({"contraction",
                           SecondsSince(start),
                           {{"edges", static_cast<double>(skeleton.edge_count())}}});
  return skeleton;
}

// CurveFusion 3.3, "Wire radius estimation".
RadiusEstimate MeasureRadii(const SkeletonGraph& skeleton, const Sequence& sequence,
                            const PipelineOptions& options, Reconstruction& result) {
  const Clock::time_point start = Clock::now();
  std::vector<int> frames(sequence.frame_count());
  std::iota(frames.begin(), frames.end(), 0);
  const RadiusEstimate estimate = EstimateRadius(skeleton, sequence, frames, options.radius);
  result.stages.push_back(
      {"radius", SecondsSince(start), {{"strips", static_cast<double>(estimate.strips.size())}}});
  return estimate;
}

}  // namespace

PipelineOptions ProfileOptions(Profile profile) {
  PipelineOptions options;
  if (profile == Profile::kPaper) {
    options.segmentation.difference.front_distance = 0.02;
    options.segmentation.difference.accept_where_nothing_rendered = false;
    options.fusion = PaperSkeletonFusionOptions();
    options.radius.strip_model = false;
    options.radius.per_edge = false;
    return options;
  }
  options.volume.voxel_size = 0.01;
  options.volume_stride = 2;
  options.segmentation.render_divisor = 2;
  options.segmentation.difference.front_distance = 0.02;
  options.segmentation.difference.silhouette_margin_px = 6;
  options.segmentation.difference.accept_where_nothing_rendered = false;
  options.segmentation.difference.min_neighbours = 8;
  options.segmentation.bundle.min_frames = 3;
  options.segmentation.edges.tolerance_px = 2;
  options.segmentation.ghosts.verified_outline = 0.35;
  options.carry_points = true;
  options.axis_depth = 0.8;
  return options;
}

void VisitOptions(PipelineOptions& options, OptionVisitor& visitor) {
  visitor.BeginSection("volume");
  VisitOptions(options.volume, visitor);
  visitor.Visit({"stride", "frames", 1, 100,
                 "Deviation: only every so many-th frame is integrated; large surfaces are seen "
                 "often enough."},
                options.volume_stride);
  VisitOptions(options.segmentation, visitor);
}

Reconstruction Reconstruct(const Sequence& sequence, const PipelineOptions& options,
                           PipelineObserver& observer) {
  Reconstruction result;
  const TsdfVolume volume = FuseVolume(sequence, options, observer, result);
  const std::vector<ObservedPoints> bundles =
      SegmentBundles(sequence, volume, options, observer, result);
  if (options.carry_points) {
    result.points = CarryPoints(bundles, options, observer, result);
    result.skeleton = ContractOnce(result.points, options, observer, result);
  } else {
    for (const ObservedPoints& bundle : bundles) {
      for (size_t i = 0; i < bundle.size(); ++i) {
        result.points.Add(bundle.positions[i], bundle.viewing_rays[i], bundle.counts[i]);
      }
    }
    result.skeleton = FuseBundleSkeletons(bundles, options, observer, result);
  }
  const RadiusEstimate radii = MeasureRadii(result.skeleton, sequence, options, result);
  result.global_radius = radii.global_radius;
  AssignRadii(radii, options.radius, result.skeleton);
  return result;
}

}  // namespace curvefusion
