#pragma once

#include "graph/contraction/ridge_skeleton.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Adds the curves of `candidates` (FindColourCandidates), contracted with `options`, but for what
/// runs along curves of the skeleton; joins their ends with what lies ahead of them
/// (CloseFreeEnds), and drops what hangs together with none of them: an object is one piece. They
/// have the radius given, in metres. Returns how many metres were added.
double AddCandidateCurves(const ObservedPoints& candidates, const RidgeOptions& options,
                          double radius, SkeletonGraph& skeleton);

}  // namespace curvefusion
