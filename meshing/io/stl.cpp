#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <vector>

#include "kernel/error.h"
#include "meshing/io/mesh_formats.h"
#include "meshing/watertight.h"

namespace curvefusion {

namespace {

constexpr size_t kHeaderSize = 80;
constexpr size_t kFacetSize = 50;  // normal and three corners of three floats, two unused bytes

Vec3f WithoutNegativeZero(const Vec3f& v) { return v + Vec3f::Zero(); }

}  // namespace

void WriteStl(const TriangleMesh& mesh, std::ostream& stream) {
  std::vector<char> bytes(kHeaderSize + 4 + kFacetSize * mesh.triangles.size(), 0);
  // Must not begin with "solid": readers would take the file for an ASCII one.
  std::memcpy(bytes.data(), "CurveFusion tubes", 17);
  const uint32_t count = static_cast<uint32_t>(mesh.triangles.size());
  std::memcpy(&bytes[kHeaderSize], &count, 4);
  char* facet = bytes.data() + kHeaderSize + 4;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3f, 4> values;
    for (size_t k = 0; k < 3; ++k) values[k + 1] = WithoutNegativeZero(mesh.vertices[triangle[k]]);
    const Vec3 a = values[1].cast<double>();
    const Vec3 normal = (values[2].cast<double>() - a).cross(values[3].cast<double>() - a);
    values[0] = normal.normalized().cast<float>();
    for (size_t k = 0; k < 4; ++k) std::memcpy(facet + 12 * k, values[k].data(), 12);
    facet += kFacetSize;
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

TriangleMesh ReadStl(std::istream& stream, const std::string& name) {
  std::array<char, kHeaderSize + 4> header{};
  stream.read(header.data(), header.size());
  if (!stream) throw Error(ErrorKind::kBadInput, fmt::format("{}: no STL header", name));
  uint32_t count = 0;
  std::memcpy(&count, &header[kHeaderSize], 4);
  TriangleMesh mesh;
  for (uint32_t i = 0; i < count; ++i) {
    std::array<char, kFacetSize> facet{};
    stream.read(facet.data(), facet.size());
    if (!stream) {
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("{}: ends in facet {} of {}; only binary STL is read", name, i, count));
    }
    const int first = static_cast<int>(mesh.vertices.size());
    for (size_t k = 0; k < 3; ++k) {
      Vec3f v;
      std::memcpy(v.data(), &facet[12 * (k + 1)], 12);
      mesh.vertices.push_back(v);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return WeldVertices(mesh);
}

}  // namespace curvefusion
