#pragma once

#include "kernel/geometry.h"

namespace curvefusion {

/// The rotation of a motion as axis times angle (radians, 0 to pi).
Vec3 RotationVector(const RigidTransform& T);

/// The motion that turns by a rotation vector about the origin and then moves by a translation.
RigidTransform RigidMotion(const Vec3& rotation_vector, const Vec3& translation);

/// The motion that turns by a rotation vector about a centre and then moves by a translation.
RigidTransform RigidMotionAbout(const Vec3& center, const Vec3& rotation_vector,
                                const Vec3& translation);

/// The matrix that gives the cross product of a vector with what it is multiplied by.
inline Mat3 CrossMatrix(const Vec3& v) {
  Mat3 matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

}  // namespace curvefusion
