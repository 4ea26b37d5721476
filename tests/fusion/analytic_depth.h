#pragma once

#include <cmath>
#include <functional>

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// Depth images of shapes with known equations, without noise.

/// A Kinect-like camera.
inline PinholeCamera KinectCamera(double scale = 1) {
  return PinholeCamera{640, 480, 580, 580, 319.5, 239.5}.Scaled(scale);
}

/// Pose of a camera at `eye` that looks at `target`.
inline RigidTransform LookAt(const Vec3& eye, const Vec3& target) {
  const Vec3 z = (target - eye).normalized();
  const Vec3 helper = std::abs(z.y()) < 0.9 ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 x = helper.cross(z).normalized();
  RigidTransform T_world_camera = RigidTransform::Identity();
  T_world_camera.linear() << x, z.cross(x), z;
  T_world_camera.translation() = eye;
  return T_world_camera;
}

/// Depth along the optical axis at which a ray from `origin` along `direction` (one metre of depth
/// long) meets a shape; 0 = it does not.
using DepthAlongRay = std::function<double(const Vec3& origin, const Vec3& direction)>;

inline DepthAlongRay Sphere(const Vec3& center, double radius) {
  return [=](const Vec3& origin, const Vec3& direction) {
    const Vec3 offset = origin - center;
    const double a = direction.squaredNorm(), b = offset.dot(direction);
    const double discriminant = b * b - a * (offset.squaredNorm() - radius * radius);
    return discriminant > 0 ? std::max(0.0, (-b - std::sqrt(discriminant)) / a) : 0.0;
  };
}

/// The plane normal . p = offset.
inline DepthAlongRay Plane(const Vec3& normal, double offset) {
  return [=](const Vec3& origin, const Vec3& direction) {
    const double slope = normal.dot(direction);
    return slope == 0 ? 0.0 : std::max(0.0, (offset - normal.dot(origin)) / slope);
  };
}

/// An axis-aligned box.
inline DepthAlongRay Box(const Vec3& low, const Vec3& high) {
  return [=](const Vec3& origin, const Vec3& direction) {
    double enter = 0, leave = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
      const double t0 = (low[axis] - origin[axis]) / direction[axis];
      const double t1 = (high[axis] - origin[axis]) / direction[axis];
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    return enter < leave ? enter : 0.0;
  };
}

/// What is nearer of two shapes.
inline DepthAlongRay Union(const DepthAlongRay& a, const DepthAlongRay& b) {
  return [=](const Vec3& origin, const Vec3& direction) {
    const double depth_a = a(origin, direction), depth_b = b(origin, direction);
    if (depth_a == 0 || depth_b == 0) return depth_a + depth_b;
    return std::min(depth_a, depth_b);
  };
}

inline DepthImage RenderDepth(const DepthAlongRay& shape, const PinholeCamera& camera,
                              const RigidTransform& T_world_camera) {
  DepthImage depth(camera.width, camera.height, 0);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Vec3 ray = T_world_camera.linear() * camera.Unproject(u, v, 1.0);
      depth(u, v) = static_cast<float>(shape(T_world_camera.translation(), ray));
    }
  }
  return depth;
}

}  // namespace curvefusion
