#include "graph/edge_parts.h"

namespace curvefusion {

double Length(const Polyline& points, const EdgePart& part) {
  double length = 0;
  for (size_t i = part.first; i < part.last; ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

void KeepParts(EdgeId id, const std::vector<EdgePart>& parts, double min_length,
               SkeletonGraph& skeleton) {
  const SkeletonEdge edge = skeleton.TakeEdge(id);
  for (const EdgePart& part : parts) {
    if (Length(edge.points, part) < min_length) continue;
    const NodeId front =
        part.first == 0 ? edge.nodes[0] : skeleton.AddNode(edge.points[part.first]);
    const NodeId back = part.last + 1 == edge.points.size()
                            ? edge.nodes[1]
                            : skeleton.AddNode(edge.points[part.last]);
    skeleton.AddEdge(PartOf(edge, part.first, part.last, {front, back}));
  }
}

}  // namespace curvefusion
