#pragma once

#include <unordered_map>

#include "capture/sequence.h"
#include "fusion/volume/tsdf_volume.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/options.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

/// How surfaces of the volume are told from grilles that look like surfaces.
struct OpennessOptions {
  /// Frames, 0 to 1000: every so many-th one is asked; 0 = none is, all surfaces are closed.
  int stride = 0;
  /// Metres, 0.002 to 0.2: cells in which pixels are counted. A cell and its neighbours must hold
  /// several wires and the gaps between them.
  double cell_size = 0.02;
  /// Metres, 0 to 0.2: a pixel so far behind a surface passed through it.
  double passing_depth = 0.02;
  /// 0 to 1: where more pixels than this share passed through there is no surface. On simulated
  /// scans 99 % of the cells of real surfaces stay below .017 (noise, drift); rows of 5 mm wires
  /// show .02 to .2, those 8 mm apart less.
  double max_share = 0.025;
};
void VisitOptions(OpennessOptions& options, OptionVisitor& visitor);

/// Counts, per cell of space, the depth pixels that ended at a rendered surface and those that
/// passed through it.
class OpennessGrid {
 public:
  explicit OpennessGrid(const OpennessOptions& options) : options_(options) {}

  /// Counts the pixels of one frame against the volume's rendering, which may be smaller than
  /// `depth` by an integer factor; `camera` is that of the rendering. Left out are pixels next to
  /// silhouettes, where a pose's error alone lets pixels pass. Linear in pixels.
  void AddFrame(const DepthImage& depth, const DepthImage& rendering, const PinholeCamera& camera,
                const RigidTransform& T_world_camera);

  /// Shares of pixels that passed in each cell and its 26 neighbours, from what was added so far.
  void Pool();

  /// The share of pixels that passed near a point, as of the last Pool; 0 where none was counted.
  double Share(const Vec3& p_world) const;

  /// 1 at the pixels of a rendering where more than max_share of the pixels passed. Linear in
  /// pixels.
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

  OpennessOptions options_;
  std::unordered_map<VoxelKey, Counts, VoxelKeyHash> counts_;
  std::unordered_map<VoxelKey, float, VoxelKeyHash> shares_;
};

/// What every stride-th frame of a sequence says about the surfaces of the volume of all frames.
/// Throws Error(kBadInput) for an image that cannot be read.
OpennessGrid MeasureOpenness(const Sequence& sequence, const TsdfVolume& volume,
                             const OpennessOptions& options);

}  // namespace curvefusion
