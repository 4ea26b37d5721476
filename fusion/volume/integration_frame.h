#pragma once

#include <vector>

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// A depth image prepared for integration: what is not a depth in (0, max_depth] is 0, a border of
/// zeros surrounds it, and the greatest depth within any rectangle is found fast.
class IntegrationFrame {
 public:
  IntegrationFrame(const DepthImage& depth, const PinholeCamera& camera,
                   const RigidTransform& T_world_camera, double max_depth);

  const PinholeCamera& camera() const { return camera_; }
  const RigidTransform& T_world_camera() const { return T_world_camera_; }
  const RigidTransform& T_camera_world() const { return T_camera_world_; }
  /// Pixel (u, v) of the camera lies at (u + 1, v + 1).
  const DepthImage& padded_depth() const { return padded_; }
  /// An upper bound of the depths in pixels [u_min, u_max] x [v_min, v_max]; 0 = no measurement.
  float MaxDepthWithin(double u_min, double v_min, double u_max, double v_max) const;

 private:
  PinholeCamera camera_;
  RigidTransform T_world_camera_;
  RigidTransform T_camera_world_;
  DepthImage padded_;
  std::vector<DepthImage> max_pyramid_;  ///< level i: maxima of 2^(i+2) x 2^(i+2) pixels
};

}  // namespace curvefusion
