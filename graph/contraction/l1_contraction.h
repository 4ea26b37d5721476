#pragma once

#include "graph/contraction/branch_tracing.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// How a cloud is contracted onto its L1-medial skeleton.
struct L1Options {
  double initial_radius = 15 * kMillimetre;
  double maximum_radius = 25 * kMillimetre;
  double growth = 5 * kMillimetre;
  double sample_spacing = 0.2;
  double repulsion = 0.35;
  int minimum_neighbours = 5;
  int maximum_iterations = 15;
  double convergence = 0.002;
  BranchTracingOptions tracing;
};
void VisitOptions(L1Options& options, OptionVisitor& visitor);

/// The options for wires of another size or a cloud in another unit: initial_radius as given, every
/// other length in proportion.
L1Options OptionsForRadius(double initial_radius, L1Options options = {});

/// Contracts a well-spread subset of the points onto local medians of all points while keeping the
/// samples apart along the curves (Huang et al. 2013, Eq. 1 to 7). The neighbourhood grows from
/// initial_radius to maximum_radius; samples whose neighbourhood has become a line stop there and
/// are not drawn into larger ones (CurveFusion 4.2). Throws Error(kBadInput) for a point that is
/// not finite. Cost: samples x neighbours x iterations.
ContractedSamples ContractToMedian(const ObservedPoints& points, const L1Options& options);

/// ContractToMedian, then TraceBranches. An empty graph where there is nothing curve-like.
SkeletonGraph ExtractL1Skeleton(const ObservedPoints& points, const L1Options& options);

}  // namespace curvefusion
