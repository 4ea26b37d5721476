#include "graph/graph_figures.h"

#include <utility>

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

double TypicalRadius(const GraphFigures& figures) {
  std::vector<std::pair<double, double>> radius_length;
  for (size_t i = 0; i < figures.edge_radius.size(); ++i) {
    if (figures.edge_radius[i] <= 0) continue;
    radius_length.emplace_back(figures.edge_radius[i], figures.edge_length[i]);
  }
  return radius_length.empty() ? 0 : WeightedMedian(std::move(radius_length));
}

}  // namespace curvefusion
