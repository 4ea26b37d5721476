#include "meshing/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>

#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "meshing/mesh_formats.h"
#include "meshing/watertight.h"

namespace curvefusion {

namespace {

struct MeshFormat {
  const char* extension;
  void (*write)(const TriangleMesh&, std::ostream&);
  TriangleMesh (*read)(std::istream&, const std::string&);
};

constexpr MeshFormat kFormats[] = {
    {".ply", WritePly, ReadPly}, {".obj", WriteObj, ReadObj}, {".stl", WriteStl, ReadStl}};

const MeshFormat& FormatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const MeshFormat& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw Error(ErrorKind::kUsage, fmt::format("{}: a mesh file ends in .ply, .obj or .stl, not '{}'",
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
bool SameTriangles(const TriangleMesh& a, const TriangleMesh& b) {
  if (a.triangles.size() != b.triangles.size()) return false;
  for (size_t f = 0; f < a.triangles.size(); ++f) {
    for (size_t k = 0; k < 3; ++k) {
      if (a.vertices[a.triangles[f][k]] != b.vertices[b.triangles[f][k]]) return false;
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

}  // namespace

void WriteMesh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const MeshFileOptions& options) {
  const MeshFormat& format = FormatOf(path);
  const TriangleMesh scaled = InUnit(mesh, options.unit);
  RequireFinite(path, scaled);
  WriteFileAtomically(path, [&](const std::filesystem::path& temporary) {
    WriteStreamAtomically(temporary, [&](std::ostream& stream) { format.write(scaled, stream); });
    const TriangleMesh read_back = ReadMesh(temporary);
    if (!SameTriangles(scaled, read_back)) {
      throw Error(ErrorKind::kResource,
                  fmt::format("{}: the file does not hold what was written; is the disk sound?",
                              path.string()));
    }
    if (options.require_watertight) RequireWatertight(path, read_back);
  });
}

TriangleMesh ReadMesh(const std::filesystem::path& path) {
  const MeshFormat& format = FormatOf(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: cannot be opened", path.string()));
  }
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
