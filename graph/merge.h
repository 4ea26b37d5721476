#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Merges junctions (nodes of degree 3 and more) nearer to each other than `distance`, nearest
/// first, into their mean weighted by degree; incident edges are re-attached. Groups grow only
/// while their means are within the distance, so a row of junctions does not collapse. Edges
/// between merged junctions disappear up to a length of 2 `distance`. CurveFusion 3.3.
void MergeNearbyJunctions(SkeletonGraph& graph, double distance);

/// Where edges run side by side within `distance`, longer than a crossing explains: joins them at
/// both ends of that stretch and replaces the two parts by their mean along arc length.
/// CurveFusion 3.3, within one graph.
void MergeOverlappingEdges(SkeletonGraph& graph, double distance);

/// Shrinks edges between two different nodes to one node each, at the mean of both weighted by
/// degree; of edges that share a node only the first.
void ContractEdges(SkeletonGraph& graph, const std::vector<EdgeId>& edges);

/// Removes edges shorter than `length`, shortest first: dangling and isolated ones and self-loops
/// disappear, links between junctions shrink to one junction. Nodes of degree 2 are dissolved
/// before and after. CurveFusion 3.3: "we remove any curve segment shorter than a threshold".
void RemoveShortEdges(SkeletonGraph& graph, double length);

/// Removes dangling edges shorter than `length` that end at a junction, shortest first; edges that
/// have become one curve count as one. Isolated curves stay.
void PruneSpurs(SkeletonGraph& graph, double length);

/// Removes self-loops up to a length, of those that changed after a version, and nodes that are
/// left without edges.
void RemoveSmallLoops(SkeletonGraph& graph, double length, int since = 0);

}  // namespace curvefusion
