#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Takes apart crossings of loose wires that lie on each other, such as cables, which contraction
/// has drawn together into junctions. A junction of four or six branches is one where these go on
/// as smooth curves whose axes pass each other at about the distance at which wires of their radii
/// touch; the axes of wires that are joined meet. Welded wires may lie on each other, too. So most
/// such junctions of a connected part must be of that kind, and at a fifth of them a wire, followed
/// through the junctions, must end free and bend, as cables do and the wires of cages and grilles
/// do not. The curves then pass each other without a node. Edges without radii are left as they
/// are. Returns how many junctions were taken apart. Cost: linear in points, and for each crossing
/// in the number of junctions along its wires.
int SeparateCrossings(SkeletonGraph& graph);

}  // namespace curvefusion
