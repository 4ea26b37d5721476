#include "graph/graph_figures.h"

#include "kernel/quantile.h"

namespace curvefusion {

namespace {

double MedianOrZero(const std::vector<double>& values) {
  return values.empty() ? 0 : Median(values);
}

}  // namespace

GraphFigures MeasureGraph(const SkeletonGraph& graph) {
  GraphFigures figures;
  figures.nodes = graph.node_count();
  figures.edges = graph.edge_count();
  figures.components = graph.ComponentCount();
  figures.cycles = graph.CycleRank();
  figures.length = graph.TotalLength();
  for (const NodeId node : graph.Nodes()) {
    figures.junctions += graph.Degree(node) >= 3 ? 1 : 0;
    figures.free_ends += graph.Degree(node) == 1 ? 1 : 0;
  }
  for (const EdgeId edge : graph.Edges()) {
    figures.edge_length.push_back(Length(graph.edge(edge).points));
    figures.edge_radius.push_back(MedianOrZero(graph.edge(edge).radii));
  }
  return figures;
}

}  // namespace curvefusion
