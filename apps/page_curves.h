#pragma once

#include <nlohmann/json_fwd.hpp>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Curves as report.html draws them: in millimetres, rounded to 0.01 mm, with the points that are
/// needed to draw centre lines and outlines to within `tolerance` (metres). Nodes and edges are in
/// the order of skeleton.json; `points` is x, y, z of one point after the other, `radii` has one
/// value a point, one alone where all are the same, none where the thickness is unknown.
nlohmann::ordered_json DrawnCurves(const SkeletonGraph& graph, double tolerance);

/// The least tolerance, from 0.2 mm on in doubled steps up to 12.8 mm, at which both graphs
/// together are drawn with at most `max_points` points. Metres.
double DrawingTolerance(const SkeletonGraph& graph, const SkeletonGraph& uncertain,
                        size_t max_points);

}  // namespace curvefusion
