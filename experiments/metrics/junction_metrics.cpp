#include "experiments/metrics/junction_metrics.h"

#include <vector>

#include "experiments/metrics/point_matching.h"

namespace curvefusion {
namespace {

std::vector<Vec3> Positions(const SkeletonGraph& graph, const std::vector<NodeId>& nodes) {
  std::vector<Vec3> positions;
  for (const NodeId node : nodes) positions.push_back(graph.position(node));
  return positions;
}

// Pairs nodes of those degrees one to one.
template <class OfDegree>
JunctionScores MatchNodes(const SkeletonGraph& result, const SkeletonGraph& truth,
                          double max_distance, const OfDegree& is_wanted) {
  const auto wanted = [&](const SkeletonGraph& graph) {
    std::vector<NodeId> nodes = graph.Nodes();
    std::erase_if(nodes, [&](NodeId node) { return !is_wanted(graph.Degree(node)); });
    return nodes;
  };
  const std::vector<NodeId> found = wanted(result);
  const std::vector<NodeId> expected = wanted(truth);
  JunctionScores scores;
  scores.truth = static_cast<int>(expected.size());
  scores.found = static_cast<int>(found.size());
  const std::vector<int> partner =
      MatchPoints(Positions(truth, expected), Positions(result, found), max_distance);
  for (size_t i = 0; i < expected.size(); ++i) {
    if (partner[i] < 0) continue;
    ++scores.matched;
    if (truth.Degree(expected[i]) == result.Degree(found[partner[i]])) ++scores.valence_right;
  }
  return scores;
}

}  // namespace

PrecisionRecall TipScores::Score() const {
  return {ShareOfCount(matched, found), ShareOfCount(matched, truth)};
}

TipScores MatchTips(const SkeletonGraph& result, const SkeletonGraph& truth, double max_distance) {
  const JunctionScores scores =
      MatchNodes(result, truth, max_distance, [](int degree) { return degree == 1; });
  return {scores.truth, scores.found, scores.matched};
}

std::optional<double> JunctionScores::ValenceShare() const {
  return ShareOfCount(valence_right, truth);
}

JunctionScores MatchJunctions(const SkeletonGraph& result, const SkeletonGraph& truth,
                              double max_distance) {
  return MatchNodes(result, truth, max_distance, [](int degree) { return degree >= 3; });
}

}  // namespace curvefusion
