#include "experiments/baselines/merged_skeleton.h"

#include <vector>

#include "fusion/paper/bundle_skeleton.h"
#include "fusion/paper/colour_edge_samples.h"
#include "fusion/paper/ghost_clusters.h"
#include "fusion/paper/surface_removal.h"
#include "fusion/volume/volume_fusion.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

SkeletonOfPoints SkeletonOfAllFrames(const Sequence& sequence, const PaperOptions& options,
                                     const Progress& progress) {
  SkeletonOfPoints result;
  if (sequence.frames.empty()) return result;
  const BundleFrames all = {0, sequence.frame_count()};
  int frames = 0;
  const TsdfVolume volume = FuseVolume(
      sequence, options.volume, 1, [&] { progress("volume", ++frames, sequence.frame_count()); });
  const ObservedPoints merged =
      ResampleOnGrid(FindBundleDifference(sequence, all, volume, options.surfaces).points,
                     options.bundle.voxel_size);
  progress("difference set", 1, 1);
  PointFunnel funnel;
  const std::vector<ObservedPoints> clusters =
      RemoveGhostClusters(merged, LiftColourEdges(sequence, all, options.edges),
                          options.bundle.voxel_size, options.ghosts, funnel);
  progress("ghosts", 1, 1);
  const RigidTransform& T_world_first = sequence.frames.front().T_world_camera;
  for (const ObservedPoints& cluster : clusters) {
    Append(result.points, Transformed(cluster, T_world_first));
  }
  result.skeleton = Transformed(ExtractBundleSkeleton(clusters, options.l1), T_world_first);
  return result;
}

}  // namespace curvefusion
