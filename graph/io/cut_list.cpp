#include "graph/io/cut_list.h"

#include <fmt/format.h>

#include <string>

#include "graph/bends.h"
#include "graph/graph_figures.h"
#include "kernel/angle.h"
#include "kernel/atomic_file.h"

namespace curvefusion {

namespace {

std::string Rows(const SkeletonGraph& graph, EdgeId id, double length, double radius,
                 double tolerance) {
  const SkeletonEdge& edge = graph.edge(id);
  const BendList list = FindBends(edge.points, tolerance);
  const std::string diameter = radius > 0 ? fmt::format("{:.2f}", 2 * radius / kMillimetre) : "";
  const std::string wire = fmt::format("{},{},{},{:.2f},{},{}", id, edge.nodes[0], edge.nodes[1],
                                       length / kMillimetre, diameter, list.bends.size());
  std::string rows;
  for (size_t i = 0; i < list.bends.size(); ++i) {
    const Bend& bend = list.bends[i];
    rows += fmt::format(
        "{},{},{:.2f},{},{:.1f},{},{:.2f}\n", wire, i + 1, bend.straight / kMillimetre,
        i > 0 ? fmt::format("{:.1f}", bend.rotation / kDegree) : "", bend.angle / kDegree,
        bend.radius > 0 ? fmt::format("{:.1f}", bend.radius / kMillimetre) : "",
        bend.arc / kMillimetre);
  }
  return rows +
         fmt::format("{},{},{:.2f},,,,\n", wire, list.bends.size() + 1, list.end / kMillimetre);
}

}  // namespace

void WriteCutList(const std::filesystem::path& path, const SkeletonGraph& graph, double tolerance) {
  const GraphFigures figures = MeasureGraph(graph);
  const std::vector<EdgeId> edges = graph.Edges();
  std::string text =
      "edge,from,to,length_mm,diameter_mm,bends,step,straight_mm,rotation_deg,bend_deg,"
      "radius_mm,arc_mm\n";
  for (size_t i = 0; i < edges.size(); ++i) {
    text += Rows(graph, edges[i], figures.edge_length[i], figures.edge_radius[i], tolerance);
  }
  WriteBytesAtomically(path, text);
}

}  // namespace curvefusion
