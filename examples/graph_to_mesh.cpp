// graph_to_mesh MESH: two rods that cross become a graph with a junction, and tubes of it.
#include <cstdio>

#include <curvefusion/error.h>
#include <curvefusion/mesh_io.h>
#include <curvefusion/skeleton.h>
#include <curvefusion/tubes.h>

using namespace curvefusion;

int main(int argc, char** argv) try {
  if (argc != 2) throw Error(ErrorKind::kUsage, "usage: graph_to_mesh MESH");
  SkeletonGraph graph;
  graph.AddPolyline({{-0.1, 0, 0}, {0.1, 0, 0}});
  graph.AddPolyline({{0, -0.1, 0.0004}, {0, 0.1, 0.0004}});
  ResolveIntersections(graph, 1 * kMillimetre);  // exact: which curves meet, and where
  Validate(graph, 1 * kMillimetre, "the cross");
  SetRadius(2 * kMillimetre, graph);
  std::printf("%d nodes, %d edges\n", graph.node_count(), graph.edge_count());

  const TubeMesh tubes = BuildTubes(graph, {});
  WriteMesh(argv[1], ToTriangleMesh(tubes.surface), {});  // only if it is watertight
  std::printf("%ld faces, %.3f cm3\n", static_cast<long>(tubes.report.faces),
              tubes.report.volume * 1e6);
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return ExitCode(error.kind());
}
