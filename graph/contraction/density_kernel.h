#pragma once

#include <Eigen/Core>
#include <numbers>
#include <utility>
#include <vector>

#include "graph/contraction/packed_points.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// The kernel w(d) = (1 - d^2 / (8 sigma^2))^4 stands in for the Gaussian: it needs no exponential
/// and ends at kKernelSupport sigma. Derived: the square root of 8, with which both fall by
/// d^2 / (2 sigma^2) near the middle.
inline constexpr double kKernelSupport = 2 * std::numbers::sqrt2;
/// Variance of the kernel along a straight uniform curve through its middle, in sigma^2. Derived:
/// the integral of t^2 (1 - t^2)^4 is an eleventh of that of (1 - t^2)^4.
inline constexpr double kKernelVariance = 8.0 / 11.0;

/// What the kernels around a place add up to: the weight, and the mean and covariance of the
/// weighted points, the mean relative to the place.
struct KernelMoments {
  double weight = 0;
  Vec3 mean = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();
};

/// A kernel at a place, `stretch` times as long along a unit direction as across it. Without a
/// direction it is round.
struct KernelPlace {
  Vec3 position = Vec3::Zero();
  Vec3 direction = Vec3::Zero();
  double stretch = 1;
};

/// Points whose density is sought, with the width of their kernel. The points' counts weigh them.
class DensityField {
 public:
  /// The points must be finite.
  DensityField(const ObservedPoints& points, double sigma);

  /// The points around a place. Kept from query to query, as the next is likely nearby; clear it
  /// where the result must not depend on the queries before.
  class Neighbours {
   public:
    void Clear() { is_gathered_ = false; }

   private:
    friend class DensityField;
    PackedPoints::Neighbours around_;       // for round kernels
    std::vector<PackedPoints::Run> cells_;  // for long ones
    PackedArrays near_;
    int count_ = 0;  // of the points near
    bool is_gathered_ = false;
    KernelPlace place_;  // for which they were gathered
  };

  /// The moments of the kernel there. `neighbours` are gathered anew where those it has will not
  /// do. Linear in the points around.
  KernelMoments Moments(const KernelPlace& place, Neighbours& neighbours) const;

  double sigma() const { return sigma_; }

 private:
  bool Suffice(const Neighbours& neighbours, const KernelPlace& place) const;
  void Gather(const KernelPlace& place, Neighbours& neighbours) const;

  double sigma_;
  PackedPoints points_;
};

}  // namespace curvefusion
