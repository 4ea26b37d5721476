#include "experiments/baselines/merged_skeleton.h"

#include <vector>

#include "experiments/baselines/bridged_branches.h"
#include "experiments/baselines/volumetric_fusion.h"
#include "fusion/paper/bundle_skeleton.h"
#include "fusion/paper/colour_edge_samples.h"
#include "fusion/paper/ghost_clusters.h"
#include "fusion/paper/surface_removal.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// Each cluster by itself, as ExtractBundleSkeleton does.
SkeletonGraph BridgedSkeleton(const std::vector<ObservedPoints>& clusters,
                              const L1Options& options) {
  SkeletonGraph skeleton;
  for (const ObservedPoints& cluster : clusters) {
    AddBridgedBranches(ContractToMedian(cluster, options), options.maximum_radius, skeleton);
  }
  return skeleton;
}

}  // namespace

SkeletonOfPoints SkeletonOfFrames(const Sequence& sequence, const BundleFrames& frames,
                                  BranchStrategy strategy, const PaperOptions& options,
                                  const Progress& progress) {
  SkeletonOfPoints result;
  if (sequence.frames.empty()) return result;
  const TsdfVolume volume = FusedVolume(sequence, options.volume, progress);
  const ObservedPoints merged =
      ResampleOnGrid(FindBundleDifference(sequence, frames, volume, options.surfaces).points,
                     options.bundle.voxel_size);
  progress("difference set", 1, 1);
  PointFunnel funnel;
  const std::vector<ObservedPoints> clusters =
      RemoveGhostClusters(merged, LiftColourEdges(sequence, frames, options.edges),
                          options.bundle.voxel_size, options.ghosts, funnel);
  progress("ghosts", 1, 1);
  const RigidTransform& T_world_first = sequence.frames[frames.first].T_world_camera;
  for (const ObservedPoints& cluster : clusters) {
    Append(result.points, Transformed(cluster, T_world_first));
  }
  result.skeleton = Transformed(strategy == BranchStrategy::kBridgePoints
                                    ? BridgedSkeleton(clusters, options.l1)
                                    : ExtractBundleSkeleton(clusters, options.l1),
                                T_world_first);
  return result;
}

}  // namespace curvefusion
