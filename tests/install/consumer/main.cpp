#include "graph/io/graph_io.h"
#include "graph/skeleton_graph.h"

int main() {
  curvefusion::SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0, 0, 1}});
  const auto text = curvefusion::SkeletonToJson(graph);
  return curvefusion::SkeletonFromJson(text, "text").edge_count() == 1 ? 0 : 1;
}
