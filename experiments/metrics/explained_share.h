#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

/// Tells how much of a truth the points of a result explain, for many motions of the result.
class ExplainingPoints {
 public:
  /// `positions` must not be empty, and outlive this.
  explicit ExplainingPoints(const std::vector<Vec3>& positions);

  const Vec3& operator[](int index) const { return positions_[index]; }

  /// Index of the nearest point within `reach` of p; -1 where there is none.
  int Nearest(const Vec3& p, double reach) const;

  /// The mean over the truth's points (some) of max(0, 1 - distance to the moved result / reach).
  /// That is the share of the truth within a threshold of the result (recall), averaged over all
  /// thresholds up to the reach. False curves do not lower it.
  double ShareOf(const std::vector<Vec3>& truth, const RigidTransform& T_truth_result,
                 double reach) const;

 private:
  const std::vector<Vec3>& positions_;
  PointIndex index_;
};

}  // namespace curvefusion
