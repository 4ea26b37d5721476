#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace curvefusion {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3d;

/// A rigid motion. Names say which way it maps: `p_world = T_world_camera * p_camera`.
using RigidTransform = Eigen::Isometry3d;

/// A linear map and a translation. A RigidTransform converts to it.
using AffineTransform = Eigen::Affine3d;

/// Every length without a unit suffix is in metres; this converts what people read and write.
inline constexpr double kMillimetre = 1e-3;

}  // namespace curvefusion
