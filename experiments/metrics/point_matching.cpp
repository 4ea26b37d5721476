#include "experiments/metrics/point_matching.h"

#include "experiments/metrics/assignment.h"

namespace curvefusion {

std::vector<int> MatchPoints(const std::vector<Vec3>& expected, const std::vector<Vec3>& found,
                             double max_distance) {
  constexpr double kTooFar = 1e3;  // one more pair is worth more than any sum of distances
  Eigen::MatrixXd cost(expected.size(), found.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    for (size_t j = 0; j < found.size(); ++j) {
      const double distance = (expected[i] - found[j]).norm();
      cost(i, j) = distance < max_distance ? distance : kTooFar;
    }
  }
  std::vector<int> partner = MinimumCostAssignment(cost);
  for (size_t i = 0; i < expected.size(); ++i) {
    if (partner[i] >= 0 && cost(i, partner[i]) >= kTooFar) partner[i] = -1;
  }
  return partner;
}

}  // namespace curvefusion
