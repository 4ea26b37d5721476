#pragma once

#include <optional>

#include "experiments/metrics/precision_recall.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// How many tips (free ends: nodes where one curve ends) were found. Counts, so that several
/// objects can be pooled.
struct TipScores {
  int truth = 0;    ///< tips of the truth
  int found = 0;    ///< tips of the result
  int matched = 0;  ///< pairs of both

  PrecisionRecall Score() const;
};

/// Pairs tips of result and truth one to one, as MatchJunctions does junctions.
TipScores MatchTips(const SkeletonGraph& result, const SkeletonGraph& truth, double max_distance);

/// The same of junctions (nodes where three or more curve ends meet).
struct JunctionScores : TipScores {
  int valence_right = 0;  ///< pairs where as many curve ends meet as in truth

  /// Share of all true junctions that were found with the right valence.
  std::optional<double> ValenceShare() const;
};

/// Pairs junctions of result and truth one to one, as many as are nearer than `max_distance` to
/// each other, and of those pairings the one with the least sum of distances (Hungarian).
JunctionScores MatchJunctions(const SkeletonGraph& result, const SkeletonGraph& truth,
                              double max_distance);

}  // namespace curvefusion
