#pragma once

#include "graph/contraction/branch_tracing.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Skeleton branches in the manner of Huang et al. 2013, section 4, of samples that are
/// contracted already, added to a graph: what CurveFusion 3.2 calls the "rather sophisticated
/// strategy" that its explicit junctions replace (its figure 5). Our own program, after the
/// published description:
/// - From the sample of the greatest directionality (sigma) on, a branch goes to the nearest sample
///   ahead, within a turn of 26 degrees (cosine .9), as long as sigma is .9 or more. Five samples
///   are a branch.
/// - Each end then goes on through the samples left over, its bridge points, by the same rule
///   without sigma, until it meets a sample of another branch or of its bridge, where it is joined.
///
/// What is read into it: `radius` (metres), within which the next sample is looked for, is that of
/// the last contraction; samples within a spacing of a branch belong to it; and the samples are not
/// contracted further between the two steps, as Huang et al. do with growing neighbourhoods, so
/// that the same samples can be given to TraceBranches.
void AddBridgedBranches(const ContractedSamples& samples, double radius, SkeletonGraph& graph);

}  // namespace curvefusion
