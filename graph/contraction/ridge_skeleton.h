#pragma once

#include "graph/contraction/curve_network.h"
#include "graph/contraction/free_ends.h"
#include "graph/contraction/junction_refinement.h"
#include "graph/contraction/ridge_projection.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// The best profile's way from points to curves, in place of the L1 axis (CurveFusion 4.2).
struct RidgeOptions {
  RidgeProjectionOptions projection;
  CurveNetworkOptions network;
  FreeEndOptions free_ends;
  JunctionRefinementOptions junctions;
  double fragment_length = 0.008;
  double min_component = 0.03;
  double smoothing_length = 0.003;
  double step = 0.0015;
};

/// Visits the options of all steps, each step in a section of its own ("ridge_projection", ...).
void VisitOptions(RidgeOptions& options, OptionVisitor& visitor);

/// Points on thin structures -> their curves: ridge projection, linking, closing of gaps, junction
/// placement, smoothing. Empty where there are no curves. Edges are resampled at `step`; they carry
/// no radii and no observations. Points that are not finite do not count. Shift the points with
/// ShiftAlongRays first where radii are known.
SkeletonGraph ExtractRidgeSkeleton(const ObservedPoints& points, const RidgeOptions& options);

/// The same where the ridges of the points have been found already, with the same options.
SkeletonGraph ExtractRidgeSkeleton(const ObservedPoints& points, const RidgePoints& ridge,
                                   const RidgeOptions& options);

/// The same in a space of other lengths: the points are moved there and the curves back. Where that
/// stretches them, the tips that are straightened are so much longer.
SkeletonGraph ExtractRidgeSkeleton(const ObservedPoints& points, const RidgeOptions& options,
                                   const AffineTransform& T_space_world);

/// Drops short loops, spurs and small parts from such a skeleton, and makes curves that touch meet
/// in junctions.
void TidyRidgeSkeleton(SkeletonGraph& graph, const RidgeOptions& options);

}  // namespace curvefusion
