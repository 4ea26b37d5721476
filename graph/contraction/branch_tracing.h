#pragma once

#include <cstddef>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"
#include "kernel/options.h"

namespace curvefusion {

/// Samples of a point cloud that contraction has moved onto its curves. The three arrays have the
/// same length.
struct ContractedSamples {
  std::vector<Vec3> positions;         ///< metres
  std::vector<Vec3> directions;        ///< unit principal direction of the neighbourhood, sign free
  std::vector<double> directionality;  ///< sigma in [1/3, 1]: 1 = the neighbours lie on one line
  double spacing = 0;                  ///< metres between neighbours before contraction

  size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
};

/// How branches are traced and joined. Lengths are multiples of ContractedSamples::spacing, so that
/// they follow the scale of the cloud. Ranges and sources stand at VisitOptions.
struct BranchTracingOptions {
  double branch_directionality = 0.9;
  double maximum_bend = 0.78;
  double step_reach = 3;
  double join_reach = 5;
  double junction_link = 2;
  int minimum_samples = 5;
};
void VisitOptions(BranchTracingOptions& options, OptionVisitor& visitor);

/// Makes a graph of contracted samples: runs of samples with a clear direction become branches
/// (Huang et al. 2013, 4.2); every cluster of the samples left over is one junction, where the
/// branches that run up to it are joined; ends without a cluster between them are joined where they
/// continue each other (CurveFusion 4.2). Nodes of degree 2 are dissolved. O(n log n). Depends on
/// the order of the samples only through ties.
SkeletonGraph TraceBranches(const ContractedSamples& samples, const BranchTracingOptions& options);

}  // namespace curvefusion
