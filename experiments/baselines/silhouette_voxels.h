#pragma once

#include <vector>

#include "experiments/baselines/silhouette_maps.h"
#include "kernel/geometry.h"
#include "kernel/progress.h"
#include "kernel/triangle_mesh.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

// Tabb 2013, "Shape from Silhouette Probability Maps: Reconstruction of Thin Objects in the
// Presence of Silhouette Extraction and Calibration Error" (CVPR). Our own program, after the
// published description: voxels are occupied or empty; a pixel of a view is 1 where an occupied
// voxel covers it, otherwise 0; wanted are the labels with the least sum over all pixels of the
// squared difference between that and the silhouette probability, so that a missing and a false
// pixel cost the same. The pseudo-Boolean problem is not submodular; it is solved to a local
// minimum, in which no change of one voxel lowers the sum.
//
// What the description leaves open is read like this:
// - A voxel covers the pixels whose centres lie in the image of a ball with the cube's mean
//   projected area (Cauchy: a quarter of its surface), and always the one that its centre falls on.
// - The search starts like a visual hull: from the voxels whose pixels are silhouette in a share of
//   at least t, with the t that gives the least sum. t = 1 is the visual hull.
// - Then voxels are visited from the best supported on and changed where that lowers the sum by a
//   pixel or more, again and again until nothing changes.
// - Searched are voxels that half of the views see and that lower the sum where they stand alone:
//   the mean probability of their pixels is more than a half.

/// The occupied voxels of a grid; voxel (x, y, z) has its centre at (x, y, z) * voxel_size.
struct VoxelSet {
  double voxel_size = 0;         ///< metres
  std::vector<VoxelKey> voxels;  ///< in ascending order
  double error = 0;              ///< the sum of squared differences over all pixels of all views
};

/// Fits the voxels in `box` to the maps. Cost: linear in voxels of the box times views.
VoxelSet FitVoxelsToSilhouettes(const std::vector<SilhouetteMap>& maps,
                                const Eigen::AlignedBox3d& box, double voxel_size,
                                const Progress& progress);

/// Marching cubes of the labels as they are: closed, not smoothed.
TriangleMesh SurfaceOf(const VoxelSet& set);

}  // namespace curvefusion
