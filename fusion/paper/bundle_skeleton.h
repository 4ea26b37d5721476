#pragma once

#include <vector>

#include "graph/contraction/l1_contraction.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// The bundle skeleton, CurveFusion 4.2: "we next extract the central skeleton of each cluster of
/// the bundle by computing the L1 medial axis of the cluster". Each cluster is contracted by
/// itself: another one nearby does not draw its samples. An empty graph where nothing is
/// curve-like.
SkeletonGraph ExtractBundleSkeleton(const std::vector<ObservedPoints>& clusters,
                                    const L1Options& options);

}  // namespace curvefusion
