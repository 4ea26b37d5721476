#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "graph/point_grid.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// The kernel w(d) = (1 - d^2 / (8 sigma^2))^4 stands in for the Gaussian: it needs no exponential
/// and ends at kKernelSupport sigma.
inline constexpr double kKernelSupport = 2.8284271247461903;
/// Variance of the kernel along a straight uniform curve through its middle, in sigma^2.
inline constexpr double kKernelVariance = 8.0 / 11.0;

/// What the kernels around a place add up to: the weight, and the mean and covariance of the
/// weighted points, the mean relative to the place.
struct KernelMoments {
  double weight = 0;
  Vec3 mean = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();
};

/// Points whose density is sought, with the width of their kernel. The points' counts weigh them.
class DensityField {
 public:
  /// The points must be finite. Queries may lie up to `slack` from where their neighbours were
  /// gathered.
  DensityField(const ObservedPoints& points, double sigma, double slack);

  /// The points around a place, packed four by four.
  class Neighbours {
   public:
    void Clear();
    void Add(const Vec3f& offset, float weight);

   private:
    friend class DensityField;
    using Lanes = Eigen::Array4f;
    struct Packet {
      Lanes x, y, z, weight;
    };
    std::vector<Packet> packets_;
    int used_lanes_ = 4;
    Vec3 origin_ = Vec3::Zero();
  };

  /// All points that matter within the slack around p, into `neighbours` (overwritten).
  void Gather(const Vec3& p, Neighbours& neighbours) const;

  /// The moments at p from gathered neighbours, by a kernel that is `stretch` times as long along a
  /// unit direction as across it.
  KernelMoments Moments(const Neighbours& neighbours, const Vec3& p,
                        const Vec3& direction = Vec3::Zero(), double stretch = 1) const;

  double sigma() const { return sigma_; }

 private:
  double sigma_;
  double reach_;
  std::vector<float> weights_;
  PointGrid grid_;
};

}  // namespace curvefusion
