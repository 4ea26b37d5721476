#include "experiments/metrics/junction_metrics.h"

#include <vector>

#include "experiments/metrics/point_matching.h"

namespace curvefusion {
namespace {

std::vector<NodeId> Junctions(const SkeletonGraph& graph) {
  std::vector<NodeId> junctions;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) >= 3) junctions.push_back(node);
  }
  return junctions;
}

std::vector<Vec3> Positions(const SkeletonGraph& graph, const std::vector<NodeId>& nodes) {
  std::vector<Vec3> positions;
  for (const NodeId node : nodes) positions.push_back(graph.position(node));
  return positions;
}

}  // namespace

PrecisionRecall JunctionScores::Score() const {
  return {ShareOfCount(matched, found), ShareOfCount(matched, truth)};
}

std::optional<double> JunctionScores::ValenceShare() const {
  return ShareOfCount(valence_right, truth);
}

JunctionScores MatchJunctions(const SkeletonGraph& result, const SkeletonGraph& truth,
                              double max_distance) {
  const std::vector<NodeId> found = Junctions(result);
  const std::vector<NodeId> expected = Junctions(truth);
  JunctionScores scores{static_cast<int>(expected.size()), static_cast<int>(found.size()), 0, 0};
  const std::vector<int> partner =
      MatchPoints(Positions(truth, expected), Positions(result, found), max_distance);
  for (size_t i = 0; i < expected.size(); ++i) {
    if (partner[i] < 0) continue;
    ++scores.matched;
    if (truth.Degree(expected[i]) == result.Degree(found[partner[i]])) ++scores.valence_right;
  }
  return scores;
}

}  // namespace curvefusion
