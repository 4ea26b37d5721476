#pragma once

#include "capture/sequence.h"
#include "fusion/volume/block_allocation.h"
#include "fusion/volume/voxel_blocks.h"
#include "kernel/camera.h"
#include "kernel/image.h"
#include "kernel/progress.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// A TSDF (volume/tsdf_volume.h) that stores what lies in a box and nothing else.
class BoxVolume {
 public:
  BoxVolume(const Eigen::AlignedBox3d& box, double voxel_size);

  /// Adds a depth image (metres, 0 or NaN = invalid).
  void Integrate(const DepthImage& depth, const PinholeCamera& camera,
                 const RigidTransform& T_world_camera);

  const Eigen::AlignedBox3d& box() const { return box_; }
  double voxel_size() const { return scale_.voxel_size; }
  /// The zero crossing, open where the box or what was observed ends.
  TriangleMesh ExtractMesh() const;
  /// The mean signed distance at the sample voxel * voxel_size, metres, positive in front of
  /// surfaces; NaN where never observed.
  double DistanceAt(const VoxelKey& voxel) const;

 private:
  Eigen::AlignedBox3d box_;
  TsdfScale scale_;
  VoxelBlockGrid grid_;
};

/// Integrates every second frame of a sequence. Throws Error(kBadInput) for an image that cannot be
/// read.
BoxVolume FuseBox(const Sequence& sequence, const Eigen::AlignedBox3d& box, double voxel_size,
                  const Progress& progress);

}  // namespace curvefusion
