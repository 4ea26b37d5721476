#include "experiments/metrics/junction_metrics.h"

#include <vector>

#include "experiments/metrics/assignment.h"

namespace curvefusion {
namespace {

std::vector<NodeId> Junctions(const SkeletonGraph& graph) {
  std::vector<NodeId> junctions;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) >= 3) junctions.push_back(node);
  }
  return junctions;
}

std::optional<double> Share(int part, int whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / whole;
}

}  // namespace

PrecisionRecall JunctionScores::Score() const {
  return {Share(matched, found), Share(matched, truth)};
}

std::optional<double> JunctionScores::ValenceShare() const { return Share(valence_right, truth); }

JunctionScores MatchJunctions(const SkeletonGraph& result, const SkeletonGraph& truth,
                              double max_distance) {
  constexpr double kTooFar = 1e3;  // one more pair is worth more than any sum of distances
  const std::vector<NodeId> found = Junctions(result);
  const std::vector<NodeId> expected = Junctions(truth);
  JunctionScores scores{static_cast<int>(expected.size()), static_cast<int>(found.size()), 0, 0};
  Eigen::MatrixXd cost(expected.size(), found.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    for (size_t j = 0; j < found.size(); ++j) {
      const double distance = (truth.position(expected[i]) - result.position(found[j])).norm();
      cost(i, j) = distance < max_distance ? distance : kTooFar;
    }
  }
  const std::vector<int> partner = MinimumCostAssignment(cost);
  for (size_t i = 0; i < expected.size(); ++i) {
    if (partner[i] < 0 || cost(i, partner[i]) >= kTooFar) continue;
    ++scores.matched;
    if (truth.Degree(expected[i]) == result.Degree(found[partner[i]])) ++scores.valence_right;
  }
  return scores;
}

}  // namespace curvefusion
