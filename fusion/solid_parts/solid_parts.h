#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/volume/tsdf_volume.h"
#include "graph/skeleton_graph.h"
#include "kernel/progress.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

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
                          const Progress& progress);

/// Other curves (edited ones) as they are attached to the same solids: free ends up to 40 mm before
/// them are led on to them.
SkeletonGraph LedToSolids(SkeletonGraph skeleton, const std::vector<TriangleMesh>& solids);

}  // namespace curvefusion
