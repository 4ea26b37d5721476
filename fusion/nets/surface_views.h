#pragma once

#include <functional>

#include "capture/sequence.h"
#include "kernel/image.h"

namespace curvefusion {

/// How the colours of a surface that a depth image shows change from view to view. On a real
/// surface, and on a wire, they stay; where depth has closed a gap, every image shows another part
/// of what is behind it. All images have the same size, that of the depth image over a whole
/// number.
struct SurfaceViews {
  /// Metres; chosen: what is so much nearer hides a surface.
  static constexpr double kNearer = 0.02;

  PinholeCamera camera;
  RigidTransform T_world_camera;  ///< as aligned
  DepthImage depth;     ///< metres, where the surface is smooth, moved to where colours agree best
  Image<float> change;  ///< grey levels: mean distance of colours from their mean; -1 = not known
  Image<float> slope;   ///< grey levels a pixel of the depth image: gradient of the mean colour
  float noise = 0;      ///< grey levels: the median change
};

/// Which part of a frame is looked at.
struct SurfaceLook {
  int divisor = 1;  ///< every so many-th pixel and row; but 1, depth is not moved
  /// Whether a point of the world is of interest; empty: all are.
  std::function<bool(const Vec3& p_world)> where;
};

/// Looks at what `frame` shows, taken from T_world_camera, in up to eight images taken beside it,
/// each aligned to it by grey. `change` is empty where there are fewer than four. Throws
/// Error(kBadInput) for an image that cannot be read. Cost: pixels of interest x images x six
/// depths.
SurfaceViews LookAtSurface(const Sequence& sequence, int frame,
                           const RigidTransform& T_world_camera, const SurfaceLook& look);

/// A frame's pose moved to where an earlier frame, taken from T_world_earlier, agrees with it by
/// grey; by the sequence's own poses where it does not.
RigidTransform PoseAfter(const Sequence& sequence, int earlier,
                         const RigidTransform& T_world_earlier, int frame);

}  // namespace curvefusion
