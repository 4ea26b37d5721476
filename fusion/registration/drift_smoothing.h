#pragma once

#include <Eigen/Core>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/options.h"

namespace curvefusion {

/// How a trajectory drifts from frame to frame, and how much a measured correction counts.
struct DriftOptions {
  double translation_step = 0.0005;
  double rotation_step = 0.0005;
  /// So many registered points have their error in common, as the windows of the sensor's block
  /// matching overlap.
  double points_per_measurement = 8;
};
void VisitOptions(DriftOptions& options, OptionVisitor& visitor);

/// The correction of a frame's pose as registration measured it.
struct MeasuredCorrection {
  RigidTransform T_registered_world = RigidTransform::Identity();
  /// Of a rotation about `center` and a translation; zero where nothing was measured.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Vec3 center = Vec3::Zero();
  Vec3 camera = Vec3::Zero();  ///< where the frame's camera was, world frame
};

/// The most likely corrections of all frames, in order of time: each near what was measured for its
/// frame, as far as the measurement determines it, and near its neighbours', as poses drift little
/// from one frame to the next. Minimises sum |x_f - m_f|^2 in the metric of the measurement + sum
/// |x_(f+1) - x_f|^2 over the drift of a step, rotations taken to be small; one sparse system,
/// linear in frames. Frames without a measurement follow their neighbours. Deviation: the paper
/// registers bundles as a whole.
std::vector<RigidTransform> SmoothCorrections(const std::vector<MeasuredCorrection>& measured,
                                              const DriftOptions& options);

}  // namespace curvefusion
