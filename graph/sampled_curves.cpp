#include "graph/sampled_curves.h"

#include "kernel/polyline.h"

namespace curvefusion {

SampledCurves SampleCurvesOf(const SkeletonGraph& graph, double step) {
  SampledCurves sampled;
  for (const EdgeId id : graph.Edges()) {
    const Polyline points = Resample(graph.edge(id).points, step);
    const std::vector<double> arc_lengths = CumulativeLength(points);
    const std::vector<Vec3> tangents = Tangents(points);
    sampled.positions.insert(sampled.positions.end(), points.begin(), points.end());
    sampled.tangents.insert(sampled.tangents.end(), tangents.begin(), tangents.end());
    for (const double arc_length : arc_lengths) sampled.locations.push_back({id, arc_length});
  }
  return sampled;
}

}  // namespace curvefusion
