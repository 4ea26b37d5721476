#include "fusion/registration/trajectory_anchor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cassert>

#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

// Derived: the drift and walk of ORB-SLAM2 from frame to frame at 30 Hz, by the model of
// docs/simulator.md#pose-sources: the root of 2 sigma^2 / (30 tau) + walk^2 / 30.
constexpr double kTranslationStep = 0.00033;  // along an axis, metres
constexpr double kRotationStep = 0.00036;     // about an axis, radians
// Chosen: the weight of later frames falls exponentially, by e within sigma / step frames: nothing
// is left of it after so many, whatever the model.
constexpr size_t kMaxFrames = 60;
constexpr int kIterations = 3;  // chosen: corrections are small, the second changes the last digits

using Mat6 = Eigen::Matrix<double, 6, 6>;

// The inverse covariance of the errors along or about each axis at the frames `indices`: a random
// walk from zero at frame 0, and what each corrected pose errs for itself.
std::array<Eigen::MatrixXd, 6> Precisions(const std::vector<int>& indices,
                                          const std::vector<SmallMotion>& sigmas) {
  std::array<Eigen::MatrixXd, 6> precisions;
  const auto n = static_cast<Eigen::Index>(indices.size());
  for (int axis = 0; axis < 6; ++axis) {
    const double step = axis < 3 ? kTranslationStep : kRotationStep;
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        covariance(i, j) = step * step * std::min(indices[i], indices[j]);
      }
      covariance(i, i) += sigmas[i][axis] * sigmas[i][axis];
    }
    precisions[axis] = covariance.llt().solve(Eigen::MatrixXd::Identity(n, n));
  }
  return precisions;
}

// How the error of a pose, seen from its camera, changes with a motion of the world about `center`:
// translation, then rotation.
Mat6 ErrorByMotion(const RigidTransform& T_world_camera, const Vec3& center) {
  const Mat3 R_camera_world = T_world_camera.linear().transpose();
  const Vec3 arm = T_world_camera.translation() - center;
  Mat6 jacobian = Mat6::Zero();
  jacobian.block<3, 3>(0, 0) = R_camera_world;
  jacobian.block<3, 3>(3, 3) = R_camera_world;
  for (int axis = 0; axis < 3; ++axis) {
    jacobian.block<3, 1>(0, 3 + axis) = R_camera_world * Vec3::Unit(axis).cross(arm);
  }
  return jacobian;
}

// One Gauss-Newton step: the motion that takes `poses` nearest to the given ones.
SmallMotion AnchoringStep(const std::vector<RigidTransform>& poses,
                          const std::vector<RigidTransform>& given,
                          const std::array<Eigen::MatrixXd, 6>& precisions, const Vec3& center) {
  const auto n = static_cast<Eigen::Index>(poses.size());
  std::array<Eigen::MatrixXd, 6> jacobians;
  jacobians.fill(Eigen::MatrixXd(n, 6));
  Eigen::MatrixXd residuals(n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    residuals.row(i) = SmallMotionOf(given[i].inverse() * poses[i]);
    const Mat6 jacobian = ErrorByMotion(poses[i], center);
    for (int axis = 0; axis < 6; ++axis) jacobians[axis].row(i) = jacobian.row(axis);
  }
  Mat6 hessian = Mat6::Zero();
  SmallMotion gradient = SmallMotion::Zero();
  for (int axis = 0; axis < 6; ++axis) {
    const Eigen::MatrixXd weighted = jacobians[axis].transpose() * precisions[axis];
    hessian += weighted * jacobians[axis];
    gradient += weighted * residuals.col(axis);
  }
  return -hessian.ldlt().solve(gradient);
}

}  // namespace

RigidTransform AnchorToGivenPoses(const std::vector<RigidTransform>& given,
                                  const std::vector<int>& indices,
                                  const std::vector<RigidTransform>& corrected,
                                  const std::vector<SmallMotion>& sigmas) {
  assert(indices.size() == corrected.size() && sigmas.size() == corrected.size());
  RigidTransform T_anchored_world = RigidTransform::Identity();
  if (indices.empty()) return T_anchored_world;
  const size_t count = std::min(indices.size(), kMaxFrames);
  const std::vector<int> used(indices.begin(), indices.begin() + static_cast<int64_t>(count));
  const std::array<Eigen::MatrixXd, 6> precisions = Precisions(used, sigmas);
  const Vec3 center = corrected.front().translation();
  std::vector<RigidTransform> given_used, poses(count);
  for (const int index : used) given_used.push_back(given[index]);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    for (size_t i = 0; i < count; ++i) poses[i] = T_anchored_world * corrected[i];
    const SmallMotion step = AnchoringStep(poses, given_used, precisions, center);
    T_anchored_world = RigidMotionAbout(center, step.tail<3>(), step.head<3>()) * T_anchored_world;
  }
  return T_anchored_world;
}

}  // namespace curvefusion
