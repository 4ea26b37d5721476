#pragma once

/// @file
/// The skeleton: a graph whose edges are curves (polylines) on the wires' axes and whose nodes are
/// junctions and free ends. The paper's "curve segment" is an edge, its "junction" a node at which
/// three or more curve ends meet. Metres. Link `curvefusion::graph`.
///
///     for (const EdgeId id : skeleton.Edges()) {
///       const SkeletonEdge& edge = skeleton.edge(id);
///       // edge.points[i]; edge.radii[i], where radii are known: otherwise edge.radii is empty
///     }
///     for (const NodeId node : skeleton.Nodes()) {
///       const bool is_junction = skeleton.Degree(node) >= 3;  // a free end has degree 1
///     }
///     const GraphFigures figures = MeasureGraph(skeleton);  // counts, lengths, median radii
///
/// Nodes and edges are named by handles (NodeId, EdgeId). That of a removed edge is not used again,
/// so there may be gaps: take handles from Edges() and Nodes().
///
/// A graph made by hand, or changed, may have curves that cross without a junction:
///
///     skeleton.AddPolyline({{-0.1, 0, 0}, {0.1, 0, 0}});
///     skeleton.AddPolyline({{0, -0.1, 0.0004}, {0, 0.1, 0.0004}});
///     ResolveIntersections(skeleton, 1 * kMillimetre);     // one junction, four edges
///     Validate(skeleton, 1 * kMillimetre, "my skeleton");  // throws Error where it is not valid
///     SetRadius(2 * kMillimetre, skeleton);                // the same for all curves
///
/// Which curves meet, within that distance, is decided exactly on their coordinates; where they
/// meet is rounded to doubles (docs/graph.md). Files: `<curvefusion/skeleton_io.h>`, meshes:
/// `<curvefusion/tubes.h>`.

#include "graph/graph_figures.h"
#include "graph/intersections.h"
#include "graph/set_radius.h"
#include "graph/skeleton_graph.h"
#include "graph/validate.h"
