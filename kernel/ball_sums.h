#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/point_grid.h"

namespace curvefusion {

/// Sums of the weights of points in balls of one radius, for very many balls over dense points: two
/// points at a time, without a branch for each. Thread-safe for concurrent queries. Building costs
/// O(n log n).
class BallSums {
 public:
  /// `radius` in metres, positive. `points` must be finite; one weight each.
  BallSums(const std::vector<Vec3>& points, const std::vector<float>& weights, double radius);

  struct Sums {
    double weights = 0;
    double squares = 0;  ///< of the weights
  };

  /// The sums over the points within the radius (inclusive) of p. Linear in the points around.
  Sums Around(const Vec3& p) const;

 private:
  double radius_;
  PointGrid grid_;
  std::vector<double> x_, y_, z_, weights_;  ///< in the order of the grid
};

}  // namespace curvefusion
