#pragma once

#include <string>
#include <vector>

#include "graph/segment_pairs.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The piece that each curve of a table belongs to, by the lowest curve in it: curves hang together
/// by nodes and by the pairs of segments in contact.
std::vector<int> PiecesOf(const SegmentTable& table, const std::vector<SegmentPair>& contacts);

/// What differs between a graph and what resolving it with threshold 0 has left, "" if nothing:
/// both must be the same set of points to within `bound` metres, point by point of every segment,
/// and hang together alike: all of a piece of the graph in one component, and in one component only
/// what is one piece or pieces nearer to each other than rounding can tell. `contacts` are those of
/// the graph, by an oracle. Without spatial index, so quadratic.
std::string DifferenceFromPieces(const SkeletonGraph& graph,
                                 const std::vector<SegmentPair>& contacts,
                                 const SkeletonGraph& resolved, double bound);

}  // namespace curvefusion
