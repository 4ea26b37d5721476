#pragma once

#include <optional>

#include "experiments/metrics/precision_recall.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// How many junctions (nodes where three or more curve ends meet) were found. Counts, so that
/// several objects can be pooled.
struct JunctionScores {
  int truth = 0;          ///< junctions of the truth
  int found = 0;          ///< junctions of the result
  int matched = 0;        ///< pairs of both
  int valence_right = 0;  ///< pairs where as many curve ends meet as in truth

  PrecisionRecall Score() const;

  /// Share of all true junctions that were found with the right valence.
  std::optional<double> ValenceShare() const;
};

/// Pairs junctions of result and truth one to one, as many as are nearer than `max_distance` to
/// each other, and of those pairings the one with the least sum of distances (Hungarian).
JunctionScores MatchJunctions(const SkeletonGraph& result, const SkeletonGraph& truth,
                              double max_distance);

}  // namespace curvefusion
