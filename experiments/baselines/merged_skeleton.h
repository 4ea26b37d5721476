#pragma once

#include "capture/sequence.h"
#include "fusion/paper/paper_options.h"
#include "graph/skeleton_graph.h"
#include "kernel/progress.h"

namespace curvefusion {

/// A skeleton and the points it was contracted from, in the sequence's world frame.
struct SkeletonOfPoints {
  SkeletonGraph skeleton;
  ObservedPoints points;
};

/// The L1-medial skeleton (Huang et al. 2013) "of the aligned depth data of the whole RGBD
/// sequence" (CurveFusion, figure 2): without bundles, the alignment of their skeletons or fusion.
/// Given: what the paper's method is given, its segmentation (the difference sets of all frames,
/// without ghosts) and its radii; junctions are found as in the paper's method. Throws
/// Error(kBadInput) for an image that cannot be read.
SkeletonOfPoints SkeletonOfAllFrames(const Sequence& sequence, const PaperOptions& options,
                                     const Progress& progress);

}  // namespace curvefusion
