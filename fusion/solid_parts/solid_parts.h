#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/volume/tsdf_volume.h"
#include "graph/skeleton_graph.h"
#include "kernel/progress.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// How the solid parts of an object are found that its wires are attached to.
struct SolidPartsOptions {
  double voxel_size = 0.005;  ///< m; chosen: a Kinect's noise at .7 m is 1 to 2 mm
  double thickness = 0.01;    ///< m, of what was seen from one side only; chosen: two voxels, the
                              ///< thinnest that a volume holds
  double margin = 0.2;        ///< m, of the box around the curves; chosen: a pot or a mug beside
};

/// The solid parts of an object, and its curves as they are attached to them.
struct SolidParts {
  std::vector<TriangleMesh> solids;  ///< each closed, oriented, 2-manifold
  SkeletonGraph skeleton;            ///< free ends before the solids are led on to them
  double seen_area = 0;              ///< m^2, of the surfaces behind which the solids lie
  double room_area = 0;              ///< m^2, of planes in the box that were left out
};

/// The surfaces that the curves are attached to. Left out: what a tube explains (2 cm around it),
/// planes that go on beyond the box of the volume (floor, wall, table top), what is not attached,
/// what is smaller than a disc of 4 cm. What was seen from one side gets a thickness; what is
/// hidden within a part is filled.
SolidParts FindSolidParts(const TsdfVolume& volume, const Eigen::AlignedBox3d& box,
                          const SkeletonGraph& skeleton, double thickness);

/// The same in a volume around the curves, of the frames at the poses of `sequence`, which should
/// be the corrected ones. Throws Error(kBadInput) for an image that cannot be read.
SolidParts FindSolidParts(const Sequence& sequence, const SkeletonGraph& skeleton,
                          const SolidPartsOptions& options, const Progress& progress);

}  // namespace curvefusion
