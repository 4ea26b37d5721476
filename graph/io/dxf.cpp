#include <dxflib/dl_dxf.h>
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <string_view>

#include "graph/io/graph_formats.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

// Group codes and values of the DXF reference, release 12 (Autodesk 1992): later ones have no 3D
// polyline that dxflib writes.
constexpr int kHeaderVariable = 9;
constexpr int kFlagsCode = 70;
constexpr int kMillimetreUnits = 4;
constexpr int kClosed = 1;
constexpr int kPolyline3d = 8;
constexpr int kPolyline3dVertex = 32;
constexpr int kPlainSpline = 0;  // neither closed, periodic, rational nor planar

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
  constexpr std::string_view kEnd = "EOF\n";  // of every DXF file (Autodesk 1992)
  std::string end(kEnd.size(), ' ');
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  stream.read(end.data(), static_cast<std::streamsize>(end.size()));
  if (!stream || end != kEnd)
    throw Error(ErrorKind::kResource, path.string() + ": cannot be written; is the disk full?");
}

std::unique_ptr<DL_WriterA> OpenDxf(const std::filesystem::path& path, DL_Codes::version release,
                                    DL_Dxf& dxf) {
  std::unique_ptr<DL_WriterA> writer(dxf.out(path.c_str(), release));
  if (writer != nullptr) return writer;
  throw Error(ErrorKind::kResource, path.string() + ": cannot be opened for writing");
}

// The tables that release 2000 wants, with nothing of this drawing in them but layer 0.
void WriteTables(DL_Dxf& dxf, DL_WriterA& writer) {
  writer.sectionTables();
  dxf.writeVPort(writer);
  writer.tableLinetypes(3);
  for (const char* name : {"BYBLOCK", "BYLAYER", "CONTINUOUS"}) {
    dxf.writeLinetype(writer, DL_LinetypeData(name, "", 0, 0, 0.0));
  }
  writer.tableEnd();
  writer.tableLayers(1);
  dxf.writeLayer(writer, DL_LayerData("0", 0), DL_Attributes("", 7, -1, "CONTINUOUS", 1.0));
  writer.tableEnd();
  writer.tableStyle(1);
  dxf.writeStyle(writer, DL_StyleData("Standard", 0, 0.0, 1.0, 0.0, 0, 2.5, "txt", ""));
  writer.tableEnd();
  dxf.writeView(writer);
  dxf.writeUcs(writer);
  writer.tableAppid(1);
  dxf.writeAppid(writer, "ACAD");
  writer.tableEnd();
  dxf.writeDimStyle(writer, 1, 1, 1, 1, 1);
  dxf.writeBlockRecord(writer);
  writer.tableEnd();
  writer.sectionEnd();
  writer.sectionBlocks();
  for (const char* name : {"*Model_Space", "*Paper_Space", "*Paper_Space0"}) {
    dxf.writeBlock(writer, DL_BlockData(name, 0, 0.0, 0.0, 0.0));
    dxf.writeEndBlock(writer, name);
  }
  writer.sectionEnd();
}

void WriteSpline(const CubicSpline& spline, DL_Dxf& dxf, DL_WriterA& writer) {
  dxf.writeSpline(writer,
                  DL_SplineData(kSplineDegree, static_cast<int>(spline.knots.size()),
                                static_cast<int>(spline.points.size()), 0, kPlainSpline),
                  DL_Attributes("0", 256, -1, "BYLAYER", 1.0));
  for (const double knot : spline.knots) dxf.writeKnot(writer, DL_KnotData(knot / kMillimetre));
  for (const Vec3& point : spline.points) {
    const Vec3 p = point / kMillimetre;
    dxf.writeControlPoint(writer, DL_ControlPointData(p.x(), p.y(), p.z(), 1.0));
  }
}

}  // namespace

FormatLosses WriteDxf(const std::filesystem::path& path, const SkeletonGraph& graph) {
  DL_Dxf dxf;
  const auto writer = OpenDxf(path, DL_Codes::AC1009, dxf);
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
  return LossesOfCurves(graph, false);
}

void WriteDxfSplines(const std::filesystem::path& path, const FittedCurves& fitted) {
  DL_Dxf dxf;
  const auto writer = OpenDxf(path, DL_Codes::AC1015, dxf);
  dxf.writeHeader(*writer);
  writer->dxfString(kHeaderVariable, "$INSUNITS");
  writer->dxfInt(kFlagsCode, kMillimetreUnits);
  writer->sectionEnd();
  WriteTables(dxf, *writer);
  writer->sectionEntities();
  for (const auto& [edge, spline] : fitted) WriteSpline(spline, dxf, *writer);
  writer->sectionEnd();
  dxf.writeObjects(*writer);
  dxf.writeObjectsEnd(*writer);
  writer->dxfEOF();
  writer->close();
  RequireWhole(path);
}

}  // namespace curvefusion
