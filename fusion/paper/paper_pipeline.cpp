#include "fusion/paper/paper_pipeline.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "fusion/paper/bundle_skeleton.h"
#include "fusion/segmentation/bundle.h"
#include "fusion/stage_progress.h"
#include "fusion/volume/volume_fusion.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// Seconds a frame of 640 x 480, measured on the simulated wire cube of 150 frames by
// reconstruct --profile paper --threads 1.
constexpr double kVolumeCost = 0.0145;
constexpr double kBundleCost = 0.14;

template <class Step>
auto Timed(StageLog& log, const char* stage, const Step& step) {
  const StageLog::Timer timer(log, stage);
  return step();
}

// 4.1 "Removing large surfaces": the bundle difference set on a regular grid, in the camera of the
// bundle's first frame.
ObservedPoints RemoveLargeSurfaces(const Sequence& sequence, const BundleFrames& frames,
                                   const TsdfVolume& volume, const PaperOptions& options,
                                   PointFunnel& funnel) {
  const BundleDifference difference =
      FindBundleDifference(sequence, frames, volume, options.surfaces);
  ObservedPoints points = ResampleOnGrid(difference.points, options.bundle.voxel_size);
  funnel.frames += frames.second - frames.first;
  funnel.depth_pixels += difference.depth_pixels;
  funnel.thin_pixels += static_cast<int64_t>(difference.points.size());
  funnel.gated_pixels = funnel.thin_pixels;  // nothing gates them
  funnel.merged_points += static_cast<int64_t>(points.size());
  return points;
}

// 4.1 "Removing 'ghost' points": the clusters of the thin structure, in the camera of the bundle's
// first frame.
std::vector<ObservedPoints> RemoveGhosts(const ObservedPoints& difference_set,
                                         const Sequence& sequence, const BundleFrames& frames,
                                         const PaperOptions& options, PointFunnel& funnel) {
  return RemoveGhostClusters(difference_set, LiftColourEdges(sequence, frames, options.edges),
                             options.bundle.voxel_size, options.ghosts, funnel);
}

}  // namespace

Reconstruction ReconstructPaperAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                       const PaperOptions& options, PipelineObserver& observer) {
  Reconstruction result;
  result.sequence = sequence;
  result.warnings = sequence.warnings;
  SkeletonGraph& skeleton = result.skeleton;  // K_i
  std::vector<double> diameters;
  StageLog log;
  const auto bundles = SplitIntoBundles(sequence.frame_count(), options.bundle.frames);
  StageProgress progress(observer, "bundles", static_cast<int64_t>(bundles.size()));
  for (size_t i = 0; i < bundles.size(); ++i) {
    const BundleFrames& frames = bundles[i];
    const RigidTransform& T_world_bundle = sequence.frames[frames.first].T_world_camera;
    const std::string name = fmt::format("bundle_{:03}", i);
    PointFunnel& funnel = result.funnel.points;

    const ObservedPoints difference_set = Timed(log, "difference set", [&] {
      return RemoveLargeSurfaces(sequence, frames, volume, options, funnel);
    });
    observer.OnPoints(name + "_difference_set", Transformed(difference_set, T_world_bundle));

    const std::vector<ObservedPoints> clusters = Timed(log, "ghosts", [&] {
      return RemoveGhosts(difference_set, sequence, frames, options, funnel);
    });
    for (const ObservedPoints& cluster : clusters) {
      Append(result.points, Transformed(cluster, T_world_bundle));
    }

    // "Prior to this fusion process, we first bring each bundle skeleton to the reference frame of
    // the first bundle": here to the world that the poses are given in.
    const SkeletonGraph bundle_skeleton = Timed(log, "contraction", [&] {
      return Transformed(ExtractBundleSkeleton(clusters, options.l1), T_world_bundle);
    });
    observer.OnGraph(name + "_skeleton", bundle_skeleton);
    result.funnel.curves.contracted += bundle_skeleton.TotalLength();

    skeleton = Timed(log, "fusion", [&] {
      return FuseSkeletons(skeleton, bundle_skeleton, static_cast<int>(i), options.fusion);
    });
    observer.OnGraph(name + "_fused", skeleton);

    const std::vector<double> of_bundle = Timed(log, "radius", [&] {
      return MeasureDiameters(bundle_skeleton, sequence, frames, options.radius);
    });
    diameters.insert(diameters.end(), of_bundle.begin(), of_bundle.end());
    progress.Advance();
  }
  result.radii.global_radius = AssignProminentRadius(diameters, options.radius, skeleton);
  result.funnel.curves.curves = skeleton.TotalLength();
  log.Count("contraction", "points", static_cast<double>(result.points.size()));
  log.Count("radius", "boxes", static_cast<double>(diameters.size()));
  result.stages = log.stages();
  return result;
}

Reconstruction ReconstructPaper(const Sequence& sequence, const PaperOptions& options,
                                PipelineObserver& observer) {
  const double frames = sequence.frame_count();
  observer.OnPlan({{"volume", kVolumeCost * frames}, {"bundles", kBundleCost * frames}});
  StageProgress progress(observer, "volume", sequence.frame_count());
  const TsdfVolume volume =
      FuseVolume(sequence, options.volume, 1, [&progress] { progress.Advance(); });
  observer.OnVolume(volume);
  return ReconstructPaperAgainst(volume, sequence, options, observer);
}

}  // namespace curvefusion
