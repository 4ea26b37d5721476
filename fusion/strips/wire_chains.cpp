#include "fusion/strips/wire_chains.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "graph/corners.h"
#include "kernel/disjoint_sets.h"
#include "kernel/polyline.h"

namespace curvefusion {

namespace {

constexpr double kReach = 10 * kMillimetre;
constexpr double kMaxTurn = 0.44;
constexpr double kCorner = 1.05;

// An end of an edge at a node, and where the edge goes from there.
struct EdgeEnd {
  EdgeId edge = 0;
  Vec3 direction;
};

Vec3 DirectionFrom(const Polyline& points, bool from_back) {
  const std::vector<double> arc_lengths = CumulativeLength(points);
  const double reach = std::min(kReach, arc_lengths.back());
  const Vec3 inner = PointAt(points, arc_lengths, from_back ? arc_lengths.back() - reach : reach);
  return (inner - (from_back ? points.back() : points.front())).normalized();
}

double Turn(const Vec3& before, const Vec3& after) {
  return std::acos(std::clamp(before.normalized().dot(after.normalized()), -1.0, 1.0));
}

// The ends of the edges without a corner.
std::map<NodeId, std::vector<EdgeEnd>> EndsAtNodes(const SkeletonGraph& skeleton) {
  std::map<NodeId, std::vector<EdgeEnd>> ends;
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge& edge = skeleton.edge(id);
    if (SharpestCorner(edge.points, kCorner)) continue;
    ends[edge.nodes[0]].push_back({id, DirectionFrom(edge.points, false)});
    ends[edge.nodes[1]].push_back({id, DirectionFrom(edge.points, true)});
  }
  return ends;
}

}  // namespace

std::map<EdgeId, int> WiresOfEdges(const SkeletonGraph& skeleton) {
  const std::vector<EdgeId> edges = skeleton.Edges();
  DisjointSets sets(edges.empty() ? 0 : static_cast<size_t>(edges.back()) + 1);
  for (const auto& [node, ends] : EndsAtNodes(skeleton)) {
    std::vector<std::tuple<double, size_t, size_t>> pairs;  // turn, ends
    for (size_t i = 0; i < ends.size(); ++i) {
      for (size_t j = i + 1; j < ends.size(); ++j) {
        const double turn = Turn(-ends[i].direction, ends[j].direction);
        if (turn < kMaxTurn) pairs.emplace_back(turn, i, j);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<bool> is_taken(ends.size(), false);
    for (const auto& [turn, i, j] : pairs) {
      if (is_taken[i] || is_taken[j]) continue;
      is_taken[i] = is_taken[j] = true;
      sets.Unite(ends[i].edge, ends[j].edge);
    }
  }
  std::map<int, int> number_of_root;
  std::map<EdgeId, int> wires;
  for (const EdgeId edge : edges) {
    const auto added =
        number_of_root.emplace(sets.Root(edge), static_cast<int>(number_of_root.size()));
    wires[edge] = added.first->second;
  }
  return wires;
}

}  // namespace curvefusion
