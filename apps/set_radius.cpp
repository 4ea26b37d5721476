#include "apps/set_radius.h"

#include <vector>

namespace curvefusion {

void SetRadius(double radius, SkeletonGraph& graph) {
  for (const EdgeId edge : graph.Edges()) {
    const SkeletonEdge curve = graph.edge(edge);
    graph.SetCurve(edge, curve.points, std::vector<double>(curve.points.size(), radius),
                   curve.observations);
  }
}

}  // namespace curvefusion
