#include <dxflib/dl_dxf.h>
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <string_view>

#include "graph/io/graph_formats.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

// Group codes and values of the DXF reference, release 12: later ones have no 3D polyline that
// dxflib writes.
constexpr int kHeaderVariable = 9;
constexpr int kFlagsCode = 70;
constexpr int kMillimetreUnits = 4;
constexpr int kClosed = 1;
constexpr int kPolyline3d = 8;
constexpr int kPolyline3dVertex = 32;

void WritePolyline(const SkeletonEdge& edge, DL_Dxf& dxf, DL_WriterA& writer) {
  const bool closed = edge.nodes[0] == edge.nodes[1];
  const size_t count = edge.points.size() - (closed ? 1 : 0);
  const DL_Attributes attributes("0", 256, -1, "BYLAYER", 1.0);
  dxf.writePolyline(
      writer, DL_PolylineData(static_cast<int>(count), 0, 0, kPolyline3d | (closed ? kClosed : 0)),
      attributes);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = edge.points[i] / kMillimetre;
    dxf.writeVertex(writer, DL_VertexData(p.x(), p.y(), p.z()));
    writer.dxfInt(kFlagsCode, kPolyline3dVertex);
  }
  dxf.writePolylineEnd(writer);
}

// dxflib does not tell whether the disk was full.
void RequireWhole(const std::filesystem::path& path) {
  constexpr std::string_view kEnd = "EOF\n";
  std::string end(kEnd.size(), ' ');
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  if (!stream || end != kEnd)
    throw Error(ErrorKind::kResource, path.string() + ": cannot be written; is the disk full?");
}

FormatLosses DxfLosses(const SkeletonGraph& graph) {
  bool has_radii = false, has_observations = false;
  for (const EdgeId id : graph.Edges()) {
    has_radii = has_radii || !graph.edge(id).radii.empty();
    has_observations = has_observations || !graph.edge(id).observations.empty();
  }
  int isolated = 0;
  for (const NodeId node : graph.Nodes()) isolated += graph.Degree(node) == 0 ? 1 : 0;
  FormatLosses losses;
  if (graph.edge_count() > 0) losses.emplace_back("curves meet by coordinates only, not by nodes");
  if (isolated > 0) losses.push_back(fmt::format("{} nodes without edges are left out", isolated));
  if (has_radii) losses.emplace_back("radii are not kept");
  if (has_observations) losses.emplace_back("observation counts are not kept");
  return losses;
}

}  // namespace

FormatLosses WriteDxf(const std::filesystem::path& path, const SkeletonGraph& graph) {
  DL_Dxf dxf;
  const std::unique_ptr<DL_WriterA> writer(dxf.out(path.c_str(), DL_Codes::AC1009));
  if (writer == nullptr)
    throw Error(ErrorKind::kResource, path.string() + ": cannot be opened for writing");
  writer->sectionHeader();
  writer->dxfString(kHeaderVariable, "$ACADVER");
  writer->dxfString(1, "AC1009");
  writer->dxfString(kHeaderVariable, "$INSUNITS");
  writer->dxfInt(kFlagsCode, kMillimetreUnits);
  writer->sectionEnd();
  writer->sectionEntities();
  for (const EdgeId id : graph.Edges()) WritePolyline(graph.edge(id), dxf, *writer);
  writer->sectionEnd();
  writer->dxfEOF();
  writer->close();
  RequireWhole(path);
  return DxfLosses(graph);
}

}  // namespace curvefusion
