#pragma once

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// What resolving took: how often contacts were joined, how often vertices had to be merged because
/// joining did not come to an end, and how often even that failed and an edge was dropped.
struct ResolutionRounds {
  int joining = 0;
  int merging = 0;
  int dropping = 0;
};

/// Where edges cross, touch or come within `threshold` (metres, 0 and up) of each other or of
/// themselves (see FindContacts), makes a junction and splits both; where they run along each
/// other, makes them one edge through the midpoints of points at
/// corresponding arc lengths. Nodes of degree 2 are dissolved,
/// loops and links of a few thresholds at new junctions disappear, and so do nodes without edges.
///
/// Guaranteed for every graph: the result has no violations for the threshold (graph/validate.h);
/// a second call changes nothing; the result does not depend on the order, the direction and the
/// handles of the edges. A graph without contacts keeps its handles; any other is
/// rebuilt in canonical order (graph/canonical_form.h), and all earlier handles become invalid.
/// Which segments meet is decided exactly on the stored coordinates; new points are rounded once
/// and shared bit for bit, and what rounding moves is checked again (docs/graph.md says why this
/// ends). Throws Error(kBadInput) for coordinates that are not finite, Error(kUsage) for a
/// threshold that is negative or not finite. Near-linear in segments for graphs with few contacts.
/// CurveFusion 4.3: "if any two curve segments intersect (within a proximity threshold) at an
/// internal point, we create a new junction at this intersection and split each of the segments".
ResolutionRounds ResolveIntersections(SkeletonGraph& graph, double threshold);

}  // namespace curvefusion
