#pragma once

#include "graph/contraction/junction_refinement.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Opens short loops that their own wires fill: no place inside is farther from the loop's curves
/// than their radius and half of `pixel_size` (metres), so no image shows an opening. Contraction
/// leaves such loops where thick wires meet. The longest edge of each goes, and its junctions move
/// to where lines fitted to their branches meet, where three or more are clear enough. Edges
/// without radii are left as they are. Returns how many loops were opened. Cost: the neighbourhood
/// of each short edge between junctions.
int OpenFilledLoops(SkeletonGraph& graph, double pixel_size,
                    const JunctionRefinementOptions& options);

/// Merges junctions that are joined by an edge shorter than the diameter of the thickest wire at
/// either: it lies within the wires, where no image shows it, and wires cannot part so soon.
/// Returns how many junctions came of several. Linear in edges.
int MergeHiddenJunctions(SkeletonGraph& graph);

}  // namespace curvefusion
