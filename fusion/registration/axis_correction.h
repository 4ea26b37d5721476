#pragma once

#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/point_grid.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

/// Moves points on the visible side of wires onto their axes. A depth camera sees only the near
/// side, so the mean of what it measures lies pi/4 (uniform pixels) to 0.84 (measured) radii before
/// the axis.
class AxisCorrection {
 public:
  /// To the curves of a skeleton, where they have radii, by `axis_depth` radii. O(m log m).
  AxisCorrection(const SkeletonGraph& skeleton, double axis_depth);

  /// The points, each moved along its viewing ray by what the nearest curve says; as they are where
  /// no curve has a radius. O(n log m).
  ObservedPoints Apply(const ObservedPoints& points) const;

 private:
  AxisCorrection(const SkeletonGraph& skeleton, double axis_depth, const Polyline& curve_points);

  std::vector<double> distances_;  ///< by which points of the curves say to move, metres
  PointGrid near_;                 ///< points of the curves, for points that are near one
  PointIndex all_;                 ///< the same, for the few that are not
};

}  // namespace curvefusion
