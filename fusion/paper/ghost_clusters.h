#pragma once

#include <vector>

#include "fusion/funnel.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// CurveFusion 4.1 "Removing 'ghost' points".
struct GhostClusterOptions {
  /// Metres, 0.001 to 0.1. DBSCAN's radius; the paper gives none. Chosen: some three voxels.
  double cluster_radius = 10 * kMillimetre;
  /// Points, 1 to 1000. DBSCAN's density; the paper gives none. Ester et al. 1996, 4.2 use 4.
  int core_points = 4;
  /// Points, 1 to 100000. "Clusters smaller than ... (fewer than 10 points)".
  int min_cluster_points = 10;
  /// Metres, 0 to 10. "Isolated floating clusters (>10 cm away from any other cluster)".
  double isolation_distance = 100 * kMillimetre;
  /// 0 to 1. "Any cluster for which less than 20% of its voxels receive a lifted curve sample".
  double verified_share = 0.2;
};
void VisitOptions(GhostClusterOptions& options, OptionVisitor& visitor);

/// The DBSCAN clusters of a bundle difference set that are no ghosts, in the paper's order:
/// clusters of fewer than min_cluster_points go, then isolated ones, then those that colour does
/// not verify.
///
/// Isolated is a cluster from which every other cluster that is left is more than
/// isolation_distance away. Not in the paper's rule but in its description of ghosts, "small and
/// isolated ... thin and short point cloud segments": a cluster that extends over more than that
/// distance itself is not short and stays, for the colour to verify as one of "the remaining
/// possible thin and long clusters". Without this a clean segmentation, in which the object is one
/// cluster, would lose the object.
///
/// `edge_samples` are lifted colour edges in the frame of the points; they verify voxels of
/// `voxel_size`. What each rule drops is added to `funnel`.
std::vector<ObservedPoints> RemoveGhostClusters(const ObservedPoints& points,
                                                const std::vector<Vec3>& edge_samples,
                                                double voxel_size,
                                                const GhostClusterOptions& options,
                                                PointFunnel& funnel);

}  // namespace curvefusion
