#pragma once

#include "graph/skeleton_graph.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// When a whole edge is noise. Deviation: CurveFusion has no such test.
struct RidgeEdgeOptions {
  double ball_radius = 0.004;
  double flank_distance = 0.010;
  double node_clearance = 0.008;
  double neighbourhood = 0.025;
  double min_share = 0.5;
  double max_flank = 0.4;
  double short_loop = 0.06;
  double min_loop_share = 0.35;
};
void VisitOptions(RidgeEdgeOptions& options, OptionVisitor& visitor);

/// Removes edges that are noise beside stronger ones. Between wires the sensor scatters points,
/// along whose random crests ridges run from wire to wire. One place of a ridge tells little of
/// that (StandsOut), a whole edge surely: along noise much less was seen than along the strongest
/// edges nearby, and nearly as much on two opposite sides of it. So are weak edges of small
/// triangles, in the crotch of wires that part at a small angle. What lies within `node_clearance`
/// of a junction does not count. The weakest go first, and what they hung at is one edge again
/// before it is judged. Nodes of degree 2 are dissolved. Costs O(n k) for n vertices and k points
/// in a ball.
void DropNoiseEdges(SkeletonGraph& graph, const ObservedPoints& points,
                    const RidgeEdgeOptions& options);

}  // namespace curvefusion
