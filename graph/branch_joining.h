#pragma once

#include <vector>

#include "graph/branch_tracing.h"
#include "graph/skeleton_graph.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// The last step of TraceBranches. Every cluster of `junction_samples`, the samples that belong to
/// no branch, is a junction at its mean; the branches that run up to it end there
/// (CurveFusion 3.2). A cluster that only one branch runs up to prolongs the branch, which then
/// looks further ahead. Ends left over are joined to an end that faces them, or else to the side of
/// the branch they run up to. `spacing` is the metres that the multiples in `options` refer to.
SkeletonGraph JoinBranches(std::vector<Polyline> branches, std::vector<Vec3> junction_samples,
                           double spacing, const BranchTracingOptions& options);

}  // namespace curvefusion
