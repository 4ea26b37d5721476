#pragma once

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

}  // namespace curvefusion
