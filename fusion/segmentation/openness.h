#pragma once

#include <unordered_map>

#include "capture/sequence.h"
#include "fusion/volume/tsdf_volume.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

/// Counts, per cell of space, the depth pixels that ended at a rendered surface and those that
/// passed through it.
class OpennessGrid {
 public:
  /// Counts the pixels of one frame against the volume's rendering, which may be smaller than
  /// `depth` by an integer factor; `camera` is that of the rendering. Left out are pixels next to
  /// silhouettes, where a pose's error alone lets pixels pass. Linear in pixels.
  void AddFrame(const DepthImage& depth, const DepthImage& rendering, const PinholeCamera& camera,
                const RigidTransform& T_world_camera);

  /// Shares of pixels that passed in each cell and its 26 neighbours, from what was added so far.
  void Pool();

  /// The share of pixels that passed near a point, as of the last Pool; 0 where none was counted.
  double Share(const Vec3& p_world) const;

  /// 1 at the pixels of a rendering near which many passed. Linear in pixels.
  MaskImage Grilles(const DepthImage& rendering, const PinholeCamera& camera,
                    const RigidTransform& T_world_camera) const;

 private:
  struct Counts {
    int ended = 0;
    int passed = 0;
    Counts& operator+=(const Counts& other) {
      ended += other.ended;
      passed += other.passed;
      return *this;
    }
  };

  std::unordered_map<VoxelKey, Counts, VoxelKeyHash> counts_;
  std::unordered_map<VoxelKey, float, VoxelKeyHash> shares_;
};

/// What every stride-th frame of a sequence says about the surfaces of the volume of all frames;
/// nothing for a stride of 0. Throws Error(kBadInput) for an image that cannot be read.
OpennessGrid MeasureOpenness(const Sequence& sequence, const TsdfVolume& volume, int stride);

}  // namespace curvefusion
