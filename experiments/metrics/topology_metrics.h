#pragma once

#include <optional>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Pieces and independent cycles, of the result and in truth.
struct TopologyScores {
  int components = 0;
  int true_components = 0;
  int cycles = 0;
  int true_cycles = 0;
};
TopologyScores CompareTopology(const SkeletonGraph& result, const SkeletonGraph& truth);

/// How well paths along the curves of one graph exist in another: control points are put on the
/// nodes of `from` and every 50 mm between them (of more than 200 m of curves in proportion) and
/// snapped to the nearest curve of `to` within 10 mm; for every pair with a path between them in
/// `from`, of length a, the path between their partners in `to`, of length b, costs
/// min(1, |a - b| / a), and 1 where a partner or a path is missing. The result is 1 minus the mean
/// cost: 1 where all paths agree. No value where `from` has no path at all. Average path length
/// similarity (van Etten et al., SpaceNet, 2018). O(c (n + c) log n) for n nodes and c control
/// points.
std::optional<double> PathSimilarity(const SkeletonGraph& from, const SkeletonGraph& to);

/// Both ways: missing curves lower the first, false ones the second.
struct AplsScores {
  std::optional<double> truth_to_result;
  std::optional<double> result_to_truth;

  /// Harmonic mean; 0 where only one has a value.
  std::optional<double> Apls() const;
};
AplsScores ComparePaths(const SkeletonGraph& result, const SkeletonGraph& truth);

}  // namespace curvefusion
