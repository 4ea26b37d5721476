#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/options.h"
#include "kernel/point_grid.h"

namespace curvefusion {

/// Rigid alignment by iterative closest points (Besl and McKay 1992).
struct AlignmentOptions {
  int max_points = 2000;
  int max_iterations = 40;
  bool point_to_line = true;
};
void VisitOptions(AlignmentOptions& options, OptionVisitor& visitor);

/// Outcome of an alignment; look at `converged` and `inlier_fraction` before using it.
struct AlignmentResult {
  RigidTransform T_target_source = RigidTransform::Identity();
  double inlier_fraction = 0;  ///< part of the source points within the last gate of the target
  double rms = 0;              ///< of those points' distances to the target's lines, metres
  bool converged = false;      ///< the motion came to rest on enough points
  int iterations = 0;
  /// How well the pairs determine the motion: the normal matrix of their distances over rms^2 for a
  /// rotation about `center` (radians) and a translation (metres), as if all were independent.
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Vec3 center = Vec3::Zero();  ///< mean of the source points after the motion
};

/// Points with the directions of the lines through them.
struct CurveSamples {
  std::vector<Vec3> points;
  std::vector<Vec3> tangents;  ///< of unit length; empty = directions are not known
};

/// What can be aligned to, many times.
class AlignmentTarget {
 public:
  explicit AlignmentTarget(CurveSamples samples);
  const CurveSamples& samples() const { return samples_; }
  const PointGrid& grid() const { return grid_; }

 private:
  CurveSamples samples_;
  PointGrid grid_;
};

/// Aligns points to points that lie on lines; where tangents are not known distances are to points.
/// Motions that the correspondences do not determine (along a straight line, around it) are left
/// alone. Robust: only pairs within a gate that shrinks with the median distance count, with
/// Tukey's weights; of a wide and a narrow first gate the better result is taken. Of more than
/// `max_points` points evenly many are used. About linear in them per iteration; the same bits for
/// any number of threads.
AlignmentResult AlignPoints(const std::vector<Vec3>& points, const AlignmentTarget& target,
                            const AlignmentOptions& options);

}  // namespace curvefusion
