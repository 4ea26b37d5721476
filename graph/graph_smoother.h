#pragma once

#include "graph/smoothing.h"
#include "graph/sparse_solver.h"

namespace curvefusion {

/// Smooths graphs one after the other, with the results of SmoothGraph. As long as the numbers of
/// points and how they hang together stay the same, the symbolic factorisation is used again.
class GraphSmoother {
 public:
  SkeletonGraph Smooth(const SkeletonGraph& graph, const SmoothingOptions& options);

  /// How often the symbolic factorisation was made.
  int analyses() const { return solver_.analyses(); }

 private:
  SparseSolver solver_;
};

}  // namespace curvefusion
