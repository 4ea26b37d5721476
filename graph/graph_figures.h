#pragma once

#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// The figures people ask of a skeleton.
struct GraphFigures {
  int nodes = 0;
  int edges = 0;
  int junctions = 0;  ///< nodes where three or more curve ends meet
  int free_ends = 0;  ///< nodes where one curve ends
  int components = 0;
  int cycles = 0;
  double length = 0;                ///< metres
  std::vector<double> edge_length;  ///< metres, in the order of graph.Edges()
  std::vector<double> edge_radius;  ///< median over an edge's points in metres; 0 = unknown
};
GraphFigures MeasureGraph(const SkeletonGraph& graph);

}  // namespace curvefusion
