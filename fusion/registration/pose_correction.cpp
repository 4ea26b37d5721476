#include "fusion/registration/pose_correction.h"

#include <cassert>

#include "kernel/rigid_motion.h"

namespace curvefusion {

SmallMotion SmallMotionOf(const RigidTransform& T) {
  SmallMotion motion;
  motion << T.translation(), RotationVector(T);
  return motion;
}

RigidTransform RigidTransformOf(const SmallMotion& motion) {
  return RigidMotion(motion.tail<3>(), motion.head<3>());
}

std::vector<RigidTransform> InterpolateCorrections(const std::vector<RigidTransform>& given,
                                                   const std::vector<int>& indices,
                                                   const std::vector<RigidTransform>& corrected) {
  assert(indices.size() == corrected.size());
  if (indices.empty()) return given;
  std::vector<SmallMotion> motions;
  for (size_t i = 0; i < indices.size(); ++i) {
    motions.push_back(SmallMotionOf(given[indices[i]].inverse() * corrected[i]));
  }
  std::vector<RigidTransform> poses;
  size_t next = 0;  // the first of the indices that is not before the frame
  for (size_t frame = 0; frame < given.size(); ++frame) {
    while (next < indices.size() && indices[next] < static_cast<int>(frame)) ++next;
    SmallMotion motion = next < indices.size() ? motions[next] : motions.back();
    if (next > 0 && next < indices.size()) {
      const double share = (static_cast<double>(frame) - indices[next - 1]) /
                           static_cast<double>(indices[next] - indices[next - 1]);
      motion = (1 - share) * motions[next - 1] + share * motions[next];
    }
    poses.push_back(given[frame] * RigidTransformOf(motion));
  }
  return poses;
}

}  // namespace curvefusion
