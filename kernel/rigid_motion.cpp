#include "kernel/rigid_motion.h"

namespace curvefusion {

Vec3 RotationVector(const RigidTransform& T) {
  const Eigen::AngleAxisd rotation(T.linear());
  return rotation.angle() * rotation.axis();
}

RigidTransform RigidMotion(const Vec3& rotation_vector, const Vec3& translation) {
  RigidTransform motion = RigidTransform::Identity();
  const double angle = rotation_vector.norm();
  if (angle > 0) {
    motion.linear() = Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
  }
  motion.translation() = translation;
  return motion;
}

RigidTransform RigidMotionAbout(const Vec3& center, const Vec3& rotation_vector,
                                const Vec3& translation) {
  RigidTransform motion = RigidMotion(rotation_vector, center + translation);
  motion.translate(-center);
  return motion;
}

}  // namespace curvefusion
