#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Where edges cross, touch or come within `threshold` of each other or of themselves (see
/// FindContacts), makes a junction and splits both; where they run side by side, merges them. Nodes
/// of degree 2 are dissolved, loops and links of a few thresholds at new junctions disappear. The
/// result has no contacts, so a second call changes nothing. Which segments meet is decided
/// exactly; new points are rounded once. Near-linear in segments for graphs with few contacts;
/// terminates for every graph: what cannot be joined after some rounds is cut away, the shorter
/// edge first. CurveFusion 3.3: "if any two curve segments intersect (within a proximity threshold)
/// at an internal point, we create a new junction at this intersection and split each of the
/// segments".
void ResolveIntersections(SkeletonGraph& graph, double threshold);

}  // namespace curvefusion
