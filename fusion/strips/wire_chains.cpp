#include "fusion/strips/wire_chains.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "graph/corners.h"
#include "graph/open_ends.h"
#include "kernel/disjoint_sets.h"

namespace curvefusion {

namespace {

constexpr EndPiece kEndPiece{.length = 10 * kMillimetre};  // chosen: about two diameters
constexpr double kMaxTurn = 0.44;                          // radians; chosen: 25 degrees
// Radians. Derived: a rod bent around 10 mm turns by no more, 1 from the 10 mm before a place to
// the 10 mm behind it.
constexpr double kCorner = 1.05;

// The ends at a node of the edges without a corner.
std::vector<OpenEnd> EndsWithoutCorner(const SkeletonGraph& skeleton, NodeId node) {
  std::vector<OpenEnd> ends = EndsAt(skeleton, node, kEndPiece);
  std::erase_if(ends, [&skeleton](const OpenEnd& end) {
    return SharpestCorner(skeleton.edge(end.edge).points, kCorner).has_value();
  });
  return ends;
}

}  // namespace

std::map<EdgeId, int> WiresOfEdges(const SkeletonGraph& skeleton) {
  const std::vector<EdgeId> edges = skeleton.Edges();
  DisjointSets sets(edges.empty() ? 0 : static_cast<size_t>(edges.back()) + 1);
  for (const NodeId node : skeleton.Nodes()) {
    const std::vector<OpenEnd> ends = EndsWithoutCorner(skeleton, node);
    std::vector<std::tuple<double, size_t, size_t>> pairs;  // turn, ends
    for (size_t i = 0; i < ends.size(); ++i) {
      for (size_t j = i + 1; j < ends.size(); ++j) {
        const double cosine = -ends[i].outward.dot(ends[j].outward);
        const double turn = std::acos(std::clamp(cosine, -1.0, 1.0));
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
