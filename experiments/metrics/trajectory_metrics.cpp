#include "experiments/metrics/trajectory_metrics.h"

#include <Eigen/Geometry>
#include <cmath>

namespace curvefusion {

double AbsoluteTrajectoryError(const std::vector<RigidTransform>& estimate,
                               const std::vector<RigidTransform>& truth) {
  Eigen::Matrix3Xd from(3, truth.size());
  Eigen::Matrix3Xd to(3, truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = estimate[i].translation();
    to.col(static_cast<Eigen::Index>(i)) = truth[i].translation();
  }
  const Eigen::Matrix4d T = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3Xd residual =
      ((T.topLeftCorner<3, 3>() * from).colwise() + Vec3(T.topRightCorner<3, 1>())) - to;
  return std::sqrt(residual.colwise().squaredNorm().mean());
}

RelativePoseError RelativePoseErrors(const std::vector<RigidTransform>& estimate,
                                     const std::vector<RigidTransform>& truth, int frames_apart) {
  double squares = 0;
  double angle_squares = 0;
  const size_t pairs = truth.size() - frames_apart;
  for (size_t i = 0; i < pairs; ++i) {
    const RigidTransform error = (truth[i].inverse() * truth[i + frames_apart]).inverse() *
                                 (estimate[i].inverse() * estimate[i + frames_apart]);
    const double angle = Eigen::AngleAxisd(error.rotation()).angle();
    squares += error.translation().squaredNorm();
    angle_squares += angle * angle;
  }
  return {std::sqrt(squares / static_cast<double>(pairs)),
          std::sqrt(angle_squares / static_cast<double>(pairs))};
}

}  // namespace curvefusion
