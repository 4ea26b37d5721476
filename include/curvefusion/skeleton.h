#pragma once

/// The skeleton graph: polylines between junctions and free ends. Exact intersections, validation,
/// radii, figures.
///
///     for (const EdgeId id : skeleton.Edges()) {
///       const SkeletonEdge& edge = skeleton.edge(id);  // edge.points and edge.radii, metres
///     }

#include "graph/graph_figures.h"
#include "graph/intersections.h"
#include "graph/set_radius.h"
#include "graph/skeleton_graph.h"
#include "graph/validate.h"
