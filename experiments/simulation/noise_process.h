#pragma once

#include <cmath>

#include "experiments/simulation/random.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Six independent Ornstein-Uhlenbeck processes that start at 0: three of translation, three of
/// rotation. Sampled exactly, whatever the step.
class PoseSway {
 public:
  /// Standard deviations of one axis once the process has settled (metres, radians), and the times
  /// in which it forgets (seconds).
  PoseSway(double translation_sigma, double rotation_sigma, double translation_memory,
           double rotation_memory)
      : sigma_{translation_sigma, rotation_sigma}, memory_{translation_memory, rotation_memory} {}

  /// Moves on by `seconds`.
  void Step(double seconds, Random& random) {
    for (int part = 0; part < 2; ++part) {
      const double keep = std::exp(-seconds / memory_[part]);
      const double fresh = sigma_[part] * std::sqrt(1 - keep * keep);
      for (int axis = 0; axis < 3; ++axis) {
        value_[part][axis] = keep * value_[part][axis] + fresh * random.Normal();
      }
    }
  }

  const Vec3& translation() const { return value_[0]; }
  /// Axis times angle.
  const Vec3& rotation() const { return value_[1]; }

 private:
  double sigma_[2];
  double memory_[2];
  Vec3 value_[2] = {Vec3::Zero(), Vec3::Zero()};
};

}  // namespace curvefusion
