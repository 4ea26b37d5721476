#include "experiments/baselines/lifted_edges.h"

#include <algorithm>

#include "fusion/paper/colour_edge_samples.h"
#include "graph/contraction/l1_contraction.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

SkeletonOfPoints SkeletonOfColourEdges(const Sequence& sequence, const Eigen::AlignedBox3d& box,
                                       const PaperOptions& options, const Progress& progress) {
  ObservedPoints lifted;
  for (int i = 0; i < sequence.frame_count(); ++i) {
    const RigidTransform& T_world_camera = sequence.frames[i].T_world_camera;
    for (const Vec3& p_camera : LiftColourEdges(sequence, {i, i + 1}, options.edges)) {
      const Vec3 p = T_world_camera * p_camera;
      if (!box.contains(p)) continue;
      lifted.Add(p, (p - T_world_camera.translation()).normalized(), 1);
    }
    progress("colour edges", i + 1, sequence.frame_count());
  }
  SkeletonOfPoints result;
  result.points = ResampleOnGrid(lifted, options.bundle.voxel_size);
  result.skeleton = ExtractL1Skeleton(result.points, options.l1);
  return result;
}

}  // namespace curvefusion
