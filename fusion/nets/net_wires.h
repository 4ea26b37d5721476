#pragma once

#include <vector>

#include "capture/sequence.h"
#include "kernel/image.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

/// Where in space wires stand so close that depth shows one surface: nets, grilles, woven seats.
struct Nets {
  /// Metres; chosen: more than the gaps of up to 12 mm that depth closes.
  static constexpr double kCell = 0.015;
  /// Square metres of a net, at least, in an image or in space; chosen.
  static constexpr double kMinArea = 2e-3;
  std::vector<VoxelKey> cells;  ///< that hold net, and those beside them, ascending
  double spacing = 0;           ///< of their wires, metres, roughly
  double noise = 0;  ///< grey levels: the change of colours on surfaces (SurfaceViews::noise)

  bool empty() const { return cells.empty(); }
  /// Whether a point lies in one of the cells.
  bool Contains(const Vec3& p_world) const;
};

/// Looks for nets in a few frames, coarsely. Throws Error(kBadInput) for an image that cannot be
/// read.
Nets FindNets(const Sequence& sequence);

/// The wires of nets as one frame shows them.
struct NetWires {
  int frame = 0;
  RigidTransform T_world_camera;  ///< aligned to the frames before by what they show
  MaskImage mask;                 ///< pixels of wires in the depth image
  DepthImage depth;               ///< of these, metres
};

/// Looks for them in a few of the frames [first, last). Throws like FindNets.
std::vector<NetWires> FindNetWires(const Sequence& sequence, int first, int last, const Nets& nets);

}  // namespace curvefusion
