#include "meshing/io/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/file_extension.h"
#include "kernel/text_input.h"
#include "meshing/io/mesh_formats.h"
#include "meshing/watertight.h"

namespace curvefusion {

namespace {

struct MeshFormat {
  const char* extension;
  void (*write)(const TriangleMesh&, std::ostream&);
  TriangleMesh (*read)(std::istream&, const std::string&);
  std::optional<MeshUnit> only_unit = {};  // where the format has but one
  float step = 0;  // of decimal coordinates that are fewer digits than float32 has
  void (*write_shaded)(const TriangleMesh&, const CornerNormals&, std::ostream&) = nullptr;
};

constexpr MeshFormat kFormats[] = {
    {".ply", WritePly, ReadPly},
    {".obj", WriteObj, ReadObj},
    {".stl", WriteStl, ReadStl},
    {".glb", WriteGlb, ReadGlb, MeshUnit::kMetres, 0, WriteShadedGlb},
    {".3mf", Write3mf, Read3mf, MeshUnit::kMillimetres, 1e-6f}};

const MeshFormat& FormatOf(const std::filesystem::path& path) {
  const std::string extension = LowerCaseExtension(path);
  for (const MeshFormat& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: a mesh file ends in .ply, .obj, .stl, .glb or .3mf, not '{}'",
                          path.string(), extension));
}

TriangleMesh InUnit(const TriangleMesh& mesh, MeshUnit unit) {
  TriangleMesh scaled = mesh;
  if (unit == MeshUnit::kMetres) return scaled;
  for (Vec3f& v : scaled.vertices) v = (v.cast<double>() / kMillimetre).cast<float>();
  return scaled;
}

void RequireFinite(const std::filesystem::path& path, const TriangleMesh& mesh) {
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.vertices[v].allFinite()) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: vertex {} of the mesh is not finite", path.string(), v));
  }
}

// Whether every triangle has the same corners; the numbering of vertices may differ (STL has none).
// Where a format writes decimals of this step, coordinates may change by that and, as lib3MF
// computes them in float32, by their last bits.
bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b, float step) {
  if (a.triangles.size() != b.triangles.size()) return false;
  for (size_t f = 0; f < a.triangles.size(); ++f) {
    for (size_t k = 0; k < 3; ++k) {
      const Vec3f change = a.vertices[a.triangles[f][k]] - b.vertices[b.triangles[f][k]];
      const float size = a.vertices[a.triangles[f][k]].cwiseAbs().maxCoeff();
      const float limit = step > 0 ? step + 2 * std::numeric_limits<float>::epsilon() * size : 0;
      if (change.cwiseAbs().maxCoeff() > limit) return false;
    }
  }
  return true;
}

void RequireWatertight(const std::filesystem::path& path, const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: the mesh is empty", path.string()));
  }
  const WatertightReport report = ExamineMesh(mesh);
  if (report.IsWatertight()) return;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: the mesh is not watertight ({}); not written",
                                                path.string(), report.Defects()));
}

MeshUnit UnitOf(const MeshFormat& format, const std::filesystem::path& path,
                std::optional<MeshUnit> wish) {
  const MeshUnit unit = wish.value_or(format.only_unit.value_or(MeshUnit::kMetres));
  if (!format.only_unit || unit == *format.only_unit) return unit;
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: {} files are always in {}; leave the unit out", path.string(),
                          format.extension, unit == MeshUnit::kMetres ? "millimetres" : "metres"));
}

}  // namespace

MeshUnit DefaultUnit(const std::filesystem::path& path) {
  return UnitOf(FormatOf(path), path, std::nullopt);
}

std::optional<MeshUnit> OnlyUnit(const std::filesystem::path& path) {
  return FormatOf(path).only_unit;
}

void CheckMeshFormat(const std::filesystem::path& path, std::optional<MeshUnit> unit) {
  UnitOf(FormatOf(path), path, unit);
}

void WriteMesh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const MeshFileOptions& options) {
  const MeshFormat& format = FormatOf(path);
  const TriangleMesh scaled = InUnit(mesh, UnitOf(format, path, options.unit));
  RequireFinite(path, scaled);
  WriteFileAtomically(path, [&](const std::filesystem::path& temporary) {
    WriteStreamAtomically(temporary, [&](std::ostream& stream) {
      if (options.normals && format.write_shaded) {
        format.write_shaded(scaled, *options.normals, stream);
      } else {
        format.write(scaled, stream);
      }
    });
    const TriangleMesh read_back = ReadMesh(temporary);
    if (!SameTriangles(scaled, read_back, format.step)) {
      throw Error(ErrorKind::kResource,
                  fmt::format("{}: the file does not hold what was written; is the disk sound?",
                              path.string()));
    }
    if (options.require_watertight) RequireWatertight(path, read_back);
  });
}

TriangleMesh ReadMesh(const std::filesystem::path& path) {
  const MeshFormat& format = FormatOf(path);
  std::ifstream stream = OpenFile(path);
  TriangleMesh mesh = format.read(stream, path.string());
  RequireFinite(path, mesh);
  const int n = static_cast<int>(mesh.vertices.size());
  for (size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const int v : mesh.triangles[f]) {
      if (v < 0 || v >= n) {
        throw Error(ErrorKind::kBadInput,
                    fmt::format("{}: triangle {} uses vertex {} of {}", path.string(), f, v, n));
      }
    }
  }
  return mesh;
}

}  // namespace curvefusion
