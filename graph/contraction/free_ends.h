#pragma once

#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// When a free end is joined to what lies ahead of it. Deviation: CurveFusion leaves gaps open.
struct FreeEndOptions {
  double max_gap = 0.025;
  /// An end may reach so far over the length of its edge: short pieces are likelier to be noise.
  double max_gap_per_length = 0.7;
  double evidence_gain = 1.5;
  double evidence_radius = 0.005;
  double max_facing_gap = 0.06;
  double touch_distance = 0.007;
  double tip_length = 0.004;
};
void VisitOptions(FreeEndOptions& options, OptionVisitor& visitor);

/// Replaces the last `tip_length` of each free end by the straight continuation of the 15 mm before
/// it: at the very end of a wire its ridge turns sideways. Shorter edges stay.
void StraightenTips(SkeletonGraph& graph, const FreeEndOptions& options);

/// Joins free ends with other free ends that face them, by a curve that goes on in both directions,
/// and with curves they run into. The direction of an end is that of its last 15 mm;
/// straight ahead it may reach as far as the longest gap, less far to the sides, nowhere beyond the
/// greatest angle. It reaches farther for a curve where `points` were seen in the gap, too few to
/// make a curve. The cheapest joins come first. Ends joined end to end become one edge.
void CloseFreeEnds(SkeletonGraph& graph, const FreeEndOptions& options,
                   const ObservedPoints& points = {});

}  // namespace curvefusion
