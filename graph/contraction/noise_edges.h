#pragma once

#include "graph/contraction/ridge_contrast.h"
#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Removes edges that are noise beside stronger ones. Between wires the sensor scatters points,
/// along whose random crests ridges run from wire to wire. One place of a ridge tells little of
/// that (StandsOut), a whole edge surely: along noise much less was seen than along the strongest
/// edges nearby, and nearly as much on two opposite sides of it. What lies near a junction does not
/// count. The weakest go first, and what they hung at is one edge again before it is judged. Nodes
/// of degree 2 are dissolved. Costs O(n k) for n vertices and k points in a ball. Deviation:
/// CurveFusion has no such test.
void DropNoiseEdges(SkeletonGraph& graph, const ObservedPoints& points,
                    const RidgeContrastOptions& options);

}  // namespace curvefusion
