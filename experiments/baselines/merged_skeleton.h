#pragma once

#include "capture/sequence.h"
#include "fusion/paper/paper_options.h"
#include "fusion/paper/surface_removal.h"
#include "graph/skeleton_graph.h"
#include "kernel/progress.h"

namespace curvefusion {

/// A skeleton and the points it was contracted from, in the sequence's world frame.
struct SkeletonOfPoints {
  SkeletonGraph skeleton;
  ObservedPoints points;
};

/// How contracted samples become branches and junctions.
enum class BranchStrategy {
  kExplicitJunctions,  ///< CurveFusion 4.2 (TraceBranches)
  kBridgePoints        ///< Huang et al. 2013 (AddBridgedBranches)
};

/// The L1-medial skeleton (Huang et al. 2013) of the aligned depth of some frames: a bundle, or
/// "the whole RGBD sequence" (CurveFusion, figure 2) without the alignment and fusion of bundles.
/// Given: what the paper's method is given, its segmentation (the difference sets of these frames
/// against the volume of all, without ghosts) and its radii. Throws Error(kBadInput) for an image
/// that cannot be read.
SkeletonOfPoints SkeletonOfFrames(const Sequence& sequence, const BundleFrames& frames,
                                  BranchStrategy strategy, const PaperOptions& options,
                                  const Progress& progress);

}  // namespace curvefusion
