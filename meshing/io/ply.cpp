#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <vector>

#include "kernel/error.h"
#include "meshing/io/mesh_formats.h"

namespace curvefusion {

namespace {

static_assert(std::endian::native == std::endian::little, "PLY and STL are written as they lie");

[[noreturn]] void ThrowBadPly(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name, what));
}

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  bool is_list = false;
  Scalar count_type = Scalar::kUint8;
  Scalar type = Scalar::kFloat;
};

struct Element {
  std::string name;
  int64_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  bool ascii = false;
  std::vector<Element> elements;
};

Scalar ScalarNamed(const std::string& type, const std::string& name) {
  static const std::map<std::string, Scalar> scalars = {
      {"char", Scalar::kInt8},     {"int8", Scalar::kInt8},     {"uchar", Scalar::kUint8},
      {"uint8", Scalar::kUint8},   {"short", Scalar::kInt16},   {"int16", Scalar::kInt16},
      {"ushort", Scalar::kUint16}, {"uint16", Scalar::kUint16}, {"int", Scalar::kInt32},
      {"int32", Scalar::kInt32},   {"uint", Scalar::kUint32},   {"uint32", Scalar::kUint32},
      {"float", Scalar::kFloat},   {"float32", Scalar::kFloat}, {"double", Scalar::kDouble},
      {"float64", Scalar::kDouble}};
  const auto found = scalars.find(type);
  if (found == scalars.end()) ThrowBadPly(name, fmt::format("unknown PLY type '{}'", type));
  return found->second;
}

Property ParseProperty(std::istringstream& words, const std::string& name) {
  Property property;
  std::string type;
  words >> type;
  if (type == "list") {
    property.is_list = true;
    std::string count_type;
    words >> count_type >> type;
    property.count_type = ScalarNamed(count_type, name);
  }
  property.type = ScalarNamed(type, name);
  words >> property.name;
  return property;
}

void ParseHeaderLine(const std::string& line, const std::string& name, PlyHeader& header) {
  std::istringstream words(line);
  std::string keyword;
  words >> keyword;
  if (keyword == "format") {
    std::string format;
    words >> format;
    header.ascii = format == "ascii";
    if (!header.ascii && format != "binary_little_endian") {
      ThrowBadPly(
          name, fmt::format("PLY format '{}' is not read (ascii or binary_little_endian)", format));
    }
  } else if (keyword == "element") {
    Element element;
    words >> element.name >> element.count;
    if (!words || element.count < 0 || element.count > INT32_MAX) {
      ThrowBadPly(name, fmt::format("bad PLY header line '{}'", line));
    }
    header.elements.push_back(element);
  } else if (keyword == "property") {
    if (header.elements.empty()) ThrowBadPly(name, "PLY property before any element");
    header.elements.back().properties.push_back(ParseProperty(words, name));
  }
}

PlyHeader ReadHeader(std::istream& stream, const std::string& name) {
  PlyHeader header;
  std::string line;
  if (!std::getline(stream, line) || line.rfind("ply", 0) != 0) {
    ThrowBadPly(name, "not a PLY file (does not begin with 'ply')");
  }
  while (std::getline(stream, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line == "end_header") return header;
    ParseHeaderLine(line, name, header);
  }
  ThrowBadPly(name, "the PLY header does not end");
}

template <class T>
double ReadBinary(std::istream& stream) {
  char bytes[sizeof(T)];
  stream.read(bytes, sizeof(T));
  T value{};
  std::memcpy(&value, bytes, sizeof(T));
  return static_cast<double>(value);
}

double ReadScalar(std::istream& stream, bool ascii, Scalar type) {
  if (ascii) {
    double value = 0;
    stream >> value;
    return value;
  }
  switch (type) {
    case Scalar::kInt8:
      return ReadBinary<int8_t>(stream);
    case Scalar::kUint8:
      return ReadBinary<uint8_t>(stream);
    case Scalar::kInt16:
      return ReadBinary<int16_t>(stream);
    case Scalar::kUint16:
      return ReadBinary<uint16_t>(stream);
    case Scalar::kInt32:
      return ReadBinary<int32_t>(stream);
    case Scalar::kUint32:
      return ReadBinary<uint32_t>(stream);
    case Scalar::kFloat:
      return ReadBinary<float>(stream);
    case Scalar::kDouble:
      return ReadBinary<double>(stream);
  }
  return 0;
}

// How many values a property has here; lists begin with their number.
int64_t ValueCount(std::istream& stream, bool ascii, const Property& property,
                   const std::string& name) {
  if (!property.is_list) return 1;
  const double count = ReadScalar(stream, ascii, property.count_type);
  if (stream && !(count >= 0 && count <= INT32_MAX))
    ThrowBadPly(name, fmt::format("the list {} has {} values", property.name, count));
  return stream ? static_cast<int64_t>(count) : 0;
}

void ReadVertex(std::istream& stream, bool ascii, const Element& element, const std::string& name,
                TriangleMesh& mesh) {
  Vec3f position = Vec3f::Zero();
  for (const Property& property : element.properties) {
    const int64_t count = ValueCount(stream, ascii, property, name);
    for (int64_t k = 0; k < count && stream; ++k) {
      const double value = ReadScalar(stream, ascii, property.type);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z') {
        position[property.name[0] - 'x'] = static_cast<float>(value);
      }
    }
  }
  mesh.vertices.push_back(position);
}

void ReadFace(std::istream& stream, bool ascii, const Element& element, const std::string& name,
              TriangleMesh& mesh) {
  for (const Property& property : element.properties) {
    const int64_t count = ValueCount(stream, ascii, property, name);
    const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
    if (corners && count != 3 && stream) {
      ThrowBadPly(name, fmt::format("face {} has {} corners; only triangles are read",
                                    mesh.triangles.size(), count));
    }
    std::array<int, 3> triangle{};
    for (int64_t k = 0; k < count && stream; ++k) {
      const double value = ReadScalar(stream, ascii, property.type);
      if (!corners || !stream) continue;
      if (!(value >= 0 && value <= INT32_MAX)) {
        ThrowBadPly(name, fmt::format("face {} has the corner {}", mesh.triangles.size(), value));
      }
      triangle[static_cast<size_t>(k)] = static_cast<int>(value);
    }
    if (corners) mesh.triangles.push_back(triangle);
  }
}

// An element of no interest: read and dropped.
void SkipElement(std::istream& stream, bool ascii, const Element& element,
                 const std::string& name) {
  TriangleMesh unused;
  ReadVertex(stream, ascii, element, name, unused);
}

}  // namespace

void WritePly(const TriangleMesh& mesh, std::ostream& stream) {
  stream << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
         << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::vector<char> bytes(12 * mesh.vertices.size());
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    std::memcpy(&bytes[12 * i], mesh.vertices[i].data(), 12);
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.assign(13 * mesh.triangles.size(), 3);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::memcpy(&bytes[13 * i + 1], mesh.triangles[i].data(), 12);
  }
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

TriangleMesh ReadPly(std::istream& stream, const std::string& name) {
  const PlyHeader header = ReadHeader(stream, name);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    // Nothing to read would never end the file before the count.
    if (element.properties.empty() && element.count > 0)
      ThrowBadPly(name, fmt::format("the element {} has no properties", element.name));
    for (int64_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        ReadVertex(stream, header.ascii, element, name, mesh);
      } else if (element.name == "face") {
        ReadFace(stream, header.ascii, element, name, mesh);
      } else {
        SkipElement(stream, header.ascii, element, name);
      }
      if (!stream) {
        ThrowBadPly(name, fmt::format("ends in {} {} of {}", element.name, i, element.count));
      }
    }
  }
  return mesh;
}

}  // namespace curvefusion
