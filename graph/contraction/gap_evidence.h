#pragma once

#include <array>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/point_grid.h"

namespace curvefusion {

/// What is known of the straight path between two ends of curves.
class GapEvidence {
 public:
  /// Points within `radius` of a path, metres, lie on it.
  GapEvidence(const SkeletonGraph& graph, const ObservedPoints& points, double radius);

  /// The share of the path from a to b, but for what the ends themselves account for, along which
  /// points were seen; 0 where nothing but the ends is left.
  double PointShare(const Vec3& a, const Vec3& b) const;

  /// Whether a curve other than the two given ones crosses the path from a to b, or comes so near
  /// to it that the path would rather end there.
  bool IsCrossed(const Vec3& a, const Vec3& b, const std::array<EdgeId, 2>& own) const;

 private:
  PointGrid points_;
  bool is_empty_;
  double radius_;
  std::vector<EdgeId> edges_;  // of the points of curves_
  PointGrid curves_;
};

}  // namespace curvefusion
