#pragma once

#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// When a free end is joined to what lies ahead of it. Deviation: CurveFusion leaves gaps open.
struct FreeEndOptions {
  double max_gap = 0.014;
  double max_angle = 0.6;
  double fit_length = 0.015;
  double snap_distance = 0.006;
  double min_loop = 0.035;
};
void VisitOptions(FreeEndOptions& options, OptionVisitor& visitor);

/// Joins free ends with other free ends that face them, and with curves they run into, within
/// `max_gap` and within `max_angle` of the direction of their last `fit_length`. The cheapest joins
/// come first. Ends joined end to end become one edge.
void CloseFreeEnds(SkeletonGraph& graph, const FreeEndOptions& options);

}  // namespace curvefusion
