#pragma once

#include <string>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Gives every curve of a graph the same radius (metres, > 0), in place of what it had.
void SetRadius(double radius, SkeletonGraph& graph);

/// Gives every curve that has radii their mean at every point; the others stay without.
void SetMeanRadii(SkeletonGraph& graph);

/// Gives every curve the same radius: the median over the length of all curves that have radii, as
/// the paper keeps one radius for all (CurveFusion 4.3). A graph without radii stays as it is.
void SetMedianRadius(SkeletonGraph& graph);

/// Keeps the radii of every point ("vertex"), or does SetMeanRadii ("edge") or SetMedianRadius
/// ("global"). Throws Error(kUsage) for another name.
void ReduceRadii(const std::string& to, SkeletonGraph& graph);

}  // namespace curvefusion
