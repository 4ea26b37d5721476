#include "fusion/tracking/view_alignment.h"

#include <Eigen/Cholesky>
#include <limits>

#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

constexpr size_t kFirstLevel = 2;  // of a quarter of the size; chosen: a pose may be 10 pixels off
constexpr int kSteps = 5;          // at each level; chosen: poses move by .01 px after four
constexpr double kSmallStep = 2e-5;  // radians, metres; derived: a hundredth of a pixel

}  // namespace

ViewAlignment AlignToKeyframe(const Keyframe& keyframe, const TrackingFrame& frame,
                              const RigidTransform& T_world_guess,
                              const RigidTransform& T_color_depth) {
  PhotometricView view;
  view.T_model_frame = keyframe.T_world_camera.inverse() * T_world_guess;
  view.T_color_depth = T_color_depth;
  ViewAlignment result{T_world_guess, std::numeric_limits<double>::infinity()};
  GreyChange change = MatchGrey(keyframe.levels[kFirstLevel], frame.levels[kFirstLevel], view);
  for (size_t level = kFirstLevel + 1; level-- > 0;) {
    for (int i = 0; i < kSteps; ++i) {
      const PhotometricSums sums =
          PhotometricTerm(keyframe.levels[level], frame.levels[level], view, change);
      if (sums.points < PhotometricSums::kMinPoints) return result;
      const NormalEquations<8>::Matrix H = sums.equations.H();
      const NormalEquations<8>::Matrix damped =
          H + kDamping * H.diagonal().maxCoeff() * NormalEquations<8>::Matrix::Identity();
      const NormalEquations<8>::Vector step = -damped.ldlt().solve(sums.equations.g());
      if (!step.allFinite()) return result;
      view.T_model_frame = RigidMotion(step.segment<3>(3), step.head<3>()) * view.T_model_frame;
      change.gain += step(6);
      change.offset += step(7);
      result.deviation = sums.deviation;
      if (step.head<6>().norm() < kSmallStep) break;
    }
  }
  result.T_world_camera = keyframe.T_world_camera * view.T_model_frame;
  return result;
}

}  // namespace curvefusion
