#pragma once

#include <vector>

#include "graph/junctions.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Places along all curves of a graph. The arrays have the same length.
struct SampledCurves {
  std::vector<Vec3> positions;
  std::vector<Vec3> tangents;  ///< of unit length
  std::vector<CurveLocation> locations;
};

/// Places about every `step` metres, edge by edge, with both ends of each. Lengths count along the
/// straight lines between them.
SampledCurves SampleCurvesOf(const SkeletonGraph& graph, double step);

}  // namespace curvefusion
