#pragma once

#include <optional>

#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Pieces and independent cycles, of the result and in truth.
struct TopologyScores {
  int components = 0;
  int true_components = 0;
  int cycles = 0;
  int true_cycles = 0;
};
TopologyScores CompareTopology(const SkeletonGraph& result, const SkeletonGraph& truth);

/// How paths are compared.
struct PathOptions {
  double control_spacing = 50 * kMillimetre;  ///< greatest distance of control points on a curve,
                                              ///< of more than 200 m of curves in proportion
  double snap_distance = 10 * kMillimetre;    ///< how far the other graph may be from one
};

/// How well paths along the curves of one graph exist in another: control points are put on the
/// nodes of `from` and every 50 mm between them and snapped to the nearest curve of `to`; for every
/// pair with a path between them in `from`, of length a, the path between their partners in `to`,
/// of length b, costs min(1, |a - b| / a), and 1 where a partner or a path is missing. The result
/// is 1 minus the mean cost: 1 where all paths agree. No value where `from` has no path at all.
/// Average path length similarity (van Etten et al., SpaceNet, 2018). O(c (n + c) log n) for n
/// nodes and c control points.
std::optional<double> PathSimilarity(const SkeletonGraph& from, const SkeletonGraph& to,
                                     const PathOptions& options = {});

/// Both ways: missing curves lower the first, false ones the second.
struct AplsScores {
  std::optional<double> truth_to_result;
  std::optional<double> result_to_truth;

  /// Harmonic mean; 0 where only one has a value.
  std::optional<double> Apls() const;
};
AplsScores ComparePaths(const SkeletonGraph& result, const SkeletonGraph& truth);

}  // namespace curvefusion
