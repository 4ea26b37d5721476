#pragma once

#include <string>
#include <vector>

#include "graph/io/graph_formats.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Curves as mesh formats hold them: vertices, and polylines of vertex numbers. Curves meet where
/// they use the same vertex; there are no nodes.
struct IndexedCurves {
  std::vector<Vec3> vertices;
  std::vector<double> radii;             ///< empty, or one per vertex; 0 = unknown
  std::vector<std::vector<int>> curves;  ///< at least two vertices each
};

/// The graph as indexed curves: one vertex a node, in the order of graph.Nodes(), then the points
/// inside edges; one curve an edge, in the order of graph.Edges(). The radius of a node is the mean
/// of its edge ends that have one. `radii` is empty where no edge has any.
IndexedCurves CurvesOf(const SkeletonGraph& graph);

/// The graph of indexed curves: nodes are the vertices where other than two segments meet, and the
/// first vertex of every closed curve. An edge has radii where all of its vertices have. Throws
/// Error(kBadInput), with `source` and the vertices, for a segment of length zero and one that is
/// there twice. Vertices must be finite, radii not negative, vertex numbers valid. O(n log n).
SkeletonGraph GraphOf(const IndexedCurves& curves, const std::string& source);

/// What formats lose that hold indexed curves: nodes inside curves, observation counts, radii (all,
/// or where those of edges differ at a node).
FormatLosses LossesOfIndexedCurves(const SkeletonGraph& graph, bool radii_are_kept);

}  // namespace curvefusion
