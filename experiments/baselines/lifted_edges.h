#pragma once

#include "capture/sequence.h"
#include "experiments/baselines/merged_skeleton.h"
#include "fusion/paper/paper_options.h"
#include "kernel/geometry.h"
#include "kernel/progress.h"

namespace curvefusion {

/// "Simply lifting all the detected RGB edges to 3D" (CurveFusion 4.1, figure 2): the edge pixels
/// of all colour images at their raw depths, merged on a grid, and the L1-medial skeleton of these
/// points. Given: colour, depth, poses, and a box of the world outside of which nothing counts, so
/// that the room's texture is not held against it. Throws Error(kBadInput) for an image that cannot
/// be read.
SkeletonOfPoints SkeletonOfColourEdges(const Sequence& sequence, const Eigen::AlignedBox3d& box,
                                       const PaperOptions& options, const Progress& progress);

}  // namespace curvefusion
