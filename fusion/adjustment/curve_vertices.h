#pragma once

#include <array>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The curves of a skeleton as unknowns of an adjustment: vertices at equal steps, of which edges
/// that meet share the one at their node.
struct CurveVertices {
  std::vector<Vec3> positions;
  std::vector<double> radii;            ///< metres; 0 where the skeleton has none
  std::vector<std::vector<int>> edges;  ///< vertices along each edge, in the order of Edges()
  /// Three vertices in a row along smooth curves: within edges, from their first to their last, and
  /// after these through nodes where two ends continue one another.
  std::vector<std::array<int, 3>> rows;
};

/// Samples every edge at steps as near to `step` (metres) as divides it evenly. A node where
/// exactly two ends, or the straightest two of more, turn by less than `corner_angle` (radians)
/// lies on a smooth curve; so does every place within an edge with less turn.
CurveVertices SampleVertices(const SkeletonGraph& skeleton, double step, double corner_angle);

/// The skeleton with the vertices' positions in place of its curves; radii and observations are
/// interpolated. `vertices` must come from SampleVertices of the same skeleton and step.
SkeletonGraph WithVertices(const SkeletonGraph& skeleton, const CurveVertices& vertices,
                           double step);

}  // namespace curvefusion
