#pragma once

#include <vector>

#include "graph/contraction/packed_points.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// The sums over the points around a place of which L1 contraction is made (Huang et al.
/// 2013, 3.1). Nearer points count more, by theta(r) = exp(-r^2 / (h/2)^2), and those beyond the
/// radius h nothing. Single precision. Thread-safe, as PackedPoints is.
class L1Neighbourhood {
 public:
  /// Positions must be finite, as many as weights; `radius` and `softening`, metres, positive. A
  /// distance d counts as sqrt(d^2 + softening^2), since 1 / d has no value on a point.
  L1Neighbourhood(const std::vector<Vec3>& positions, const std::vector<float>& weights,
                  double radius, double softening);

  /// The sum of the weights of all points, each times theta. Linear in the points around, too.
  double DensityAt(const Vec3& place, PackedPoints::Neighbours& neighbours) const;

  /// One step of Weiszfeld's iteration from a place towards the weighted median: the mean of the
  /// points around, each by theta(d) / d. The place itself where there are none. Linear in the
  /// points around.
  Vec3 StepToMedian(const Vec3& place, PackedPoints::Neighbours& neighbours) const;

  /// What pushes a place away from the others around.
  struct Repulsion {
    Vec3 offset = Vec3::Zero();      ///< mean of the offsets from them, by theta(d) / d^2
    Mat3 covariance = Mat3::Zero();  ///< sum of the squared offsets, by theta(d)
  };
  /// Points in the very place are left out: it is one of them. Zero where there are no others.
  /// Linear in the points around.
  Repulsion RepulsionAt(const Vec3& place, PackedPoints::Neighbours& neighbours) const;

 private:
  double radius_;
  double softening_;
  PackedPoints points_;
};

}  // namespace curvefusion
