#include "experiments/metrics/tip_metrics.h"

#include <algorithm>
#include <vector>

#include "experiments/metrics/point_matching.h"

namespace curvefusion {
namespace {

std::vector<Vec3> Tips(const SkeletonGraph& graph) {
  std::vector<Vec3> tips;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) == 1) tips.push_back(graph.position(node));
  }
  return tips;
}

}  // namespace

PrecisionRecall TipScores::Score() const {
  return {ShareOfCount(matched, found), ShareOfCount(matched, truth)};
}

TipScores MatchTips(const SkeletonGraph& result, const SkeletonGraph& truth, double max_distance) {
  const std::vector<Vec3> found = Tips(result);
  const std::vector<Vec3> expected = Tips(truth);
  const std::vector<int> partner = MatchPoints(expected, found, max_distance);
  const auto unmatched = std::count(partner.begin(), partner.end(), -1);
  return {static_cast<int>(expected.size()), static_cast<int>(found.size()),
          static_cast<int>(expected.size()) - static_cast<int>(unmatched)};
}

}  // namespace curvefusion
