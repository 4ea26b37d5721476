#pragma once

#include <array>
#include <vector>

#include "graph/contraction/branch_tracing.h"
#include "graph/skeleton_graph.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// A run of samples: `points` are means of a few samples each, so they stop short of the outermost
/// sample at either end, which is in `tips` (front, back).
struct Branch {
  Polyline points;
  std::array<Vec3, 2> tips;
};

/// The last step of TraceBranches. Every cluster of `junction_samples`, the samples that belong to
/// no branch, is a junction, and the branches that run up to it end there (CurveFusion 4.2), in the
/// point nearest to their lines. A cluster that only one branch runs up to prolongs the branch,
/// which then looks further ahead. Ends left over are joined to an end that faces them, or else to
/// the side of the branch they run up to, or else they reach out to their tips. `spacing` is the
/// metres that the multiples in `options` refer to.
SkeletonGraph JoinBranches(std::vector<Branch> branches, std::vector<Vec3> junction_samples,
                           double spacing, const BranchTracingOptions& options);

}  // namespace curvefusion
