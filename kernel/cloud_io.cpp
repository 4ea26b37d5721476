#include "kernel/cloud_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/pcd_points.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

// What is kept of a vertex, in the order of the arrays below.
constexpr std::array<const char*, 7> kFields = {"x", "y", "z", "ray_x", "ray_y", "ray_z", "count"};
constexpr size_t kCountField = 6;
using Vertex = std::array<double, kFields.size()>;
constexpr std::uintmax_t kMaxCloudBytes = std::uintmax_t{4} << 30;
constexpr Vertex kAbsentFields = {0, 0, 0, 0, 0, 0, 1};

enum class ScalarType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
constexpr std::array<size_t, 8> kScalarSize = {1, 1, 2, 2, 4, 4, 4, 8};

struct Property {
  ScalarType type;
  int field;  // index into kFields, or -1 for what is not kept
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  Encoding encoding = Encoding::kAscii;
  size_t vertex_count = 0;
  std::vector<Property> properties;
};

[[noreturn]] void Reject(const std::filesystem::path& path, const std::string& what) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), what));
}

// Where something stands in a file, for messages: "line 12", "vertex 3".
struct Place {
  const char* unit;
  size_t number;
};

std::string Name(const Place& place) { return fmt::format("{} {}", place.unit, place.number); }

void AddVertex(const std::filesystem::path& path, const Place& place, const Vertex& vertex,
               ObservedPoints& points) {
  for (size_t k = 0; k < vertex.size(); ++k) {
    if (!std::isfinite(vertex[k])) {
      Reject(path, fmt::format("{}: {} is {}; remove points without a position", Name(place),
                               kFields[k], vertex[k]));
    }
  }
  if (!(vertex[kCountField] > 0)) {
    Reject(path,
           fmt::format("{}: count is {}, it must be positive", Name(place), vertex[kCountField]));
  }
  points.Add({vertex[0], vertex[1], vertex[2]}, {vertex[3], vertex[4], vertex[5]},
             static_cast<float>(vertex[kCountField]));
}

ObservedPoints ReadXyz(const std::filesystem::path& path, std::string_view content) {
  ObservedPoints points;
  LineScanner lines(content);
  std::string_view line;
  while (lines.Next(line)) {
    line = line.substr(0, line.find('#'));
    std::array<double, 6> columns{};
    size_t count = 0;
    const Place place{"line", lines.number()};
    for (std::string_view word = NextWord(line); !word.empty(); word = NextWord(line), ++count) {
      const std::optional<double> value = ParseNumber(word);
      if (!value) Reject(path, fmt::format("{}: '{}' is not a number", Name(place), word));
      if (count < columns.size()) columns[count] = *value;
    }
    if (count == 0) continue;
    if (count != 3 && count != 6) {
      Reject(path, fmt::format("{}: {} columns; 'x y z' or 'x y z nx ny nz' is expected",
                               Name(place), count));
    }
    AddVertex(path, place, {columns[0], columns[1], columns[2], 0, 0, 0, 1}, points);
  }
  if (points.empty()) Reject(path, "no point in it; a PLY, PCD or XYZ point cloud is expected");
  return points;
}

std::optional<ScalarType> ScalarTypeOf(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<ScalarType>(i);
  }
  return std::nullopt;
}

Encoding EncodingOf(const std::filesystem::path& path, std::string_view name) {
  if (name == "ascii") return Encoding::kAscii;
  if (name == "binary_little_endian") return Encoding::kLittleEndian;
  if (name == "binary_big_endian") return Encoding::kBigEndian;
  Reject(path, fmt::format("PLY format '{}' is not known", name));
}

Property ParseProperty(const std::filesystem::path& path, size_t line_number,
                       std::string_view words) {
  const std::string_view type_name = NextWord(words);
  const std::optional<ScalarType> type = ScalarTypeOf(type_name);
  if (!type) {
    Reject(path, fmt::format("line {}: vertex property type '{}' cannot be read; a scalar type is "
                             "expected",
                             line_number, type_name));
  }
  const auto field = std::find(kFields.begin(), kFields.end(), NextWord(words));
  return {*type, field == kFields.end() ? -1 : static_cast<int>(field - kFields.begin())};
}

size_t ParseVertexCount(const std::filesystem::path& path, size_t line_number,
                        std::string_view word) {
  const std::optional<int64_t> count = ParseInteger(word);
  if (!count || *count < 0)
    Reject(path, fmt::format("line {}: '{}' is not a number of vertices", line_number, word));
  return static_cast<size_t>(*count);
}

void RequirePosition(const std::filesystem::path& path, const PlyHeader& header) {
  for (int field = 0; field < 3; ++field) {
    const auto count = std::count_if(header.properties.begin(), header.properties.end(),
                                     [field](const Property& p) { return p.field == field; });
    if (count != 1) {
      Reject(path, fmt::format("the vertices have {} properties '{}'; one is expected", count,
                               kFields[field]));
    }
  }
}

// Leaves `lines` at the first byte of the body.
PlyHeader ReadPlyHeader(const std::filesystem::path& path, LineScanner& lines) {
  PlyHeader header;
  std::string_view line, element;
  while (lines.Next(line)) {
    const std::string_view keyword = NextWord(line);
    if (keyword == "format") header.encoding = EncodingOf(path, NextWord(line));
    if (keyword == "element") {
      const bool is_first = element.empty();
      element = NextWord(line);
      if (is_first && element != "vertex") {
        Reject(path, fmt::format("line {}: element '{}' precedes the vertices, which cannot be "
                                 "read; write the vertices first",
                                 lines.number(), element));
      }
      if (is_first) header.vertex_count = ParseVertexCount(path, lines.number(), NextWord(line));
    }
    if (keyword == "property" && element == "vertex")
      header.properties.push_back(ParseProperty(path, lines.number(), line));
    if (keyword == "end_header") {
      RequirePosition(path, header);
      return header;
    }
  }
  Reject(path, "the PLY header has no end_header; is the file truncated?");
}

void ReadAsciiVertices(const std::filesystem::path& path, const PlyHeader& header,
                       LineScanner& lines, ObservedPoints& points) {
  std::string_view line;
  for (size_t i = 0; i < header.vertex_count; ++i) {
    if (!lines.Next(line)) {
      Reject(path, fmt::format("truncated: {} of {} vertices", i, header.vertex_count));
    }
    Vertex vertex = kAbsentFields;
    const Place place{"line", lines.number()};
    for (const Property& property : header.properties) {
      const std::string_view word = NextWord(line);
      const std::optional<double> value = ParseNumber(word);
      if (!value) Reject(path, fmt::format("{}: '{}' is not a number", Name(place), word));
      if (property.field >= 0) vertex[property.field] = *value;
    }
    AddVertex(path, place, vertex, points);
  }
}

template <class T>
double Decode(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> ordered;
  std::copy_n(bytes, sizeof(T), ordered.begin());
  if (swapped) std::reverse(ordered.begin(), ordered.end());
  return static_cast<double>(std::bit_cast<T>(ordered));
}

double DecodeScalar(const char* bytes, ScalarType type, bool swapped) {
  switch (type) {
    case ScalarType::kInt8:
      return Decode<int8_t>(bytes, swapped);
    case ScalarType::kUint8:
      return Decode<uint8_t>(bytes, swapped);
    case ScalarType::kInt16:
      return Decode<int16_t>(bytes, swapped);
    case ScalarType::kUint16:
      return Decode<uint16_t>(bytes, swapped);
    case ScalarType::kInt32:
      return Decode<int32_t>(bytes, swapped);
    case ScalarType::kUint32:
      return Decode<uint32_t>(bytes, swapped);
    case ScalarType::kFloat:
      return Decode<float>(bytes, swapped);
    case ScalarType::kDouble:
      return Decode<double>(bytes, swapped);
  }
  assert(false);
  return 0;
}

void ReadBinaryVertices(const std::filesystem::path& path, const PlyHeader& header,
                        std::string_view body, ObservedPoints& points) {
  static_assert(std::endian::native == std::endian::little);
  const bool swapped = header.encoding == Encoding::kBigEndian;
  size_t vertex_size = 0;
  for (const Property& p : header.properties) vertex_size += kScalarSize[static_cast<int>(p.type)];
  if (body.size() / vertex_size < header.vertex_count) {
    Reject(path, fmt::format("truncated: {} of {} vertices", body.size() / vertex_size,
                             header.vertex_count));
  }
  points.Reserve(header.vertex_count);
  const char* bytes = body.data();
  for (size_t i = 0; i < header.vertex_count; ++i) {
    Vertex vertex = kAbsentFields;
    for (const Property& property : header.properties) {
      if (property.field >= 0) vertex[property.field] = DecodeScalar(bytes, property.type, swapped);
      bytes += kScalarSize[static_cast<int>(property.type)];
    }
    AddVertex(path, {"vertex", i}, vertex, points);
  }
}

ObservedPoints ReadPly(const std::filesystem::path& path, std::string_view content) {
  LineScanner lines(content);
  const PlyHeader header = ReadPlyHeader(path, lines);
  ObservedPoints points;
  if (header.encoding == Encoding::kAscii) {
    ReadAsciiVertices(path, header, lines, points);
  } else {
    ReadBinaryVertices(path, header, lines.rest(), points);
  }
  return points;
}

ObservedPoints ReadPcd(const std::filesystem::path& path, std::string_view content) {
  ObservedPoints points;
  for (const Vec3& p : ReadPcdPoints(path, content)) {
    AddVertex(path, {"measured point", points.size()}, {p.x(), p.y(), p.z(), 0, 0, 0, 1}, points);
  }
  return points;
}

}  // namespace

ObservedPoints ReadCloud(const std::filesystem::path& path) {
  const std::string content = ReadFile(path, kMaxCloudBytes);
  if (content.empty()) Reject(path, "the file is empty; a PLY, PCD or XYZ point cloud is expected");
  const bool is_ply = content.starts_with("ply\n") || content.starts_with("ply\r\n");
  if (IsPcd(content)) return ReadPcd(path, content);
  return is_ply ? ReadPly(path, content) : ReadXyz(path, content);
}

void WriteCloud(const std::filesystem::path& path, const ObservedPoints& points) {
  static_assert(std::endian::native == std::endian::little);
  WriteStreamAtomically(path, [&points](std::ostream& stream) {
    stream << "ply\nformat binary_little_endian 1.0\nelement vertex " << points.size() << '\n';
    for (size_t k = 0; k < kFields.size(); ++k)
      stream << "property " << (k == kCountField ? "float " : "double ") << kFields[k] << '\n';
    stream << "end_header\n";
    for (size_t i = 0; i < points.size(); ++i) {
      std::array<char, 6 * sizeof(double) + sizeof(float)> bytes;
      std::memcpy(bytes.data(), points.positions[i].data(), 3 * sizeof(double));
      std::memcpy(bytes.data() + 24, points.viewing_rays[i].data(), 3 * sizeof(double));
      std::memcpy(bytes.data() + 48, &points.counts[i], sizeof(float));
      stream.write(bytes.data(), bytes.size());
    }
  });
}

}  // namespace curvefusion
