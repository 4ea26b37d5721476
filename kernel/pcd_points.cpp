#include "kernel/pcd_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

// Chosen: more than any field has (histograms of 308 and 1344 values are the longest of PCL).
constexpr int64_t kMaxFieldCount = 65536;

[[noreturn]] void Reject(const fs::path& path, const std::string& what) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), what));
}

struct Field {
  std::string name;
  size_t size = 0;
  char type = 'F';
  size_t count = 1;  // values a point

  size_t bytes() const { return size * count; }
};

struct Header {
  std::vector<Field> fields;
  size_t points = 0;
  std::string data;
  std::array<size_t, 3> axes{};  // of x, y and z in fields
};

size_t Number(const fs::path& path, std::string_view word, const char* key, int64_t max) {
  const std::optional<int64_t> number = ParseInteger(word);
  if (!number || *number < 0 || *number > max) {
    Reject(path, fmt::format("{} '{}' in the PCD header is no number up to {}", key, word, max));
  }
  return static_cast<size_t>(*number);
}

// Sets one property of all fields from the words of a header line.
template <class Set>
void SetFields(const fs::path& path, const char* key, std::string_view words, Header& header,
               const Set& set) {
  for (Field& field : header.fields) {
    const std::string_view word = NextWord(words);
    if (word.empty()) Reject(path, fmt::format("the PCD header has too few words in {}", key));
    set(field, word);
  }
}

void ParseLine(const fs::path& path, std::string_view line, Header& header) {
  const std::string_view key = NextWord(line);
  if (key == "FIELDS" || key == "COLUMNS") {
    for (std::string_view word = NextWord(line); !word.empty(); word = NextWord(line)) {
      header.fields.push_back({std::string(word)});
    }
  } else if (key == "SIZE") {
    SetFields(path, "SIZE", line, header, [&](Field& field, std::string_view word) {
      field.size = Number(path, word, "SIZE", 8);
    });
  } else if (key == "TYPE") {
    SetFields(path, "TYPE", line, header,
              [&](Field& field, std::string_view word) { field.type = word.front(); });
  } else if (key == "COUNT") {
    SetFields(path, "COUNT", line, header, [&](Field& field, std::string_view word) {
      field.count = Number(path, word, "COUNT", kMaxFieldCount);
    });
  } else if (key == "POINTS") {
    header.points = Number(path, NextWord(line), "POINTS", int64_t{1} << 40);
  } else if (key == "DATA") {
    header.data = NextWord(line);
  }
}

// Leaves `lines` at the first byte of the data.
Header ReadHeader(const fs::path& path, LineScanner& lines) {
  Header header;
  std::string_view line;
  while (header.data.empty() && lines.Next(line)) ParseLine(path, line, header);
  if (header.data.empty()) Reject(path, "the PCD header has no DATA; is the file truncated?");
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto field = std::find_if(header.fields.begin(), header.fields.end(),
                                    [&](const Field& f) { return f.name == name; });
    if (field == header.fields.end() || field->type != 'F' || field->count != 1 ||
        (field->size != 4 && field->size != 8)) {
      Reject(path, fmt::format("the PCD file needs a field {} of type F and size 4 or 8", name));
    }
    header.axes[axis] = static_cast<size_t>(field - header.fields.begin());
  }
  return header;
}

double Decode(const char* bytes, size_t size) {
  if (size == 8) {
    double value;
    std::memcpy(&value, bytes, sizeof(value));
    return value;
  }
  float value;
  std::memcpy(&value, bytes, sizeof(value));
  return value;
}

void AddMeasured(const Vec3& p, std::vector<Vec3>& points) {
  if (!p.array().isNaN().any()) points.push_back(p);
}

std::vector<Vec3> ReadAscii(const fs::path& path, const Header& header, LineScanner& lines) {
  std::vector<Vec3> points;
  std::string_view line;
  for (size_t i = 0; i < header.points;) {
    if (!lines.Next(line)) {
      Reject(path, fmt::format("truncated: {} of {} points", i, header.points));
    }
    std::string_view words = line;
    if (NextWord(words).empty()) continue;
    Vec3 p = Vec3::Zero();
    for (size_t k = 0; k < header.fields.size(); ++k) {
      std::string_view word;
      for (size_t n = 0; n < header.fields[k].count; ++n) word = NextWord(line);
      const auto axis = std::find(header.axes.begin(), header.axes.end(), k);
      if (axis == header.axes.end()) continue;
      const std::optional<double> value = ParseNumber(word);
      if (!value) {
        Reject(path, fmt::format("line {}: '{}' is not a number", lines.number(), word));
      }
      p[axis - header.axes.begin()] = *value;
    }
    AddMeasured(p, points);
    ++i;
  }
  return points;
}

// `stride` bytes lie between two points of an axis, which begins at `first`.
struct Layout {
  std::array<size_t, 3> first{};
  std::array<size_t, 3> stride{};
};

size_t PointBytes(const Header& header) {
  size_t bytes = 0;
  for (const Field& field : header.fields) bytes += field.bytes();
  return bytes;
}

// Point by point, or (compressed) field by field.
Layout LayoutOf(const Header& header, bool by_field) {
  Layout layout;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t k = 0; k < header.axes[axis]; ++k) {
      layout.first[axis] += header.fields[k].bytes() * (by_field ? header.points : 1);
    }
    layout.stride[axis] = by_field ? header.fields[header.axes[axis]].size : PointBytes(header);
  }
  return layout;
}

std::vector<Vec3> ReadBinary(const fs::path& path, const Header& header, std::string_view body,
                             bool by_field) {
  if (body.size() / PointBytes(header) < header.points) {
    Reject(path, fmt::format("truncated: {} of {} points", body.size() / PointBytes(header),
                             header.points));
  }
  const Layout layout = LayoutOf(header, by_field);
  std::vector<Vec3> points;
  points.reserve(header.points);
  for (size_t i = 0; i < header.points; ++i) {
    Vec3 p;
    for (size_t axis = 0; axis < 3; ++axis) {
      p[static_cast<Eigen::Index>(axis)] =
          Decode(body.data() + layout.first[axis] + i * layout.stride[axis],
                 header.fields[header.axes[axis]].size);
    }
    AddMeasured(p, points);
  }
  return points;
}

// LZF (M. Lehmann): a byte below 32 is a run of literals, others copy from what was written before.
std::string DecompressLzf(const fs::path& path, std::string_view packed, size_t size) {
  std::string out;
  out.reserve(size);
  size_t at = 0;
  const auto next = [&] {
    if (at >= packed.size()) Reject(path, "the compressed PCD data is truncated or damaged");
    return static_cast<size_t>(static_cast<unsigned char>(packed[at++]));
  };
  while (at < packed.size() && out.size() < size) {
    const size_t control = next();
    if (control < 32) {
      for (size_t i = 0; i <= control; ++i) out += static_cast<char>(next());
      continue;
    }
    size_t length = control >> 5;
    if (length == 7) length += next();
    const size_t distance = ((control & 31) << 8) + next() + 1;
    if (distance > out.size()) Reject(path, "the compressed PCD data is damaged");
    for (size_t i = 0; i < length + 2; ++i) out += out[out.size() - distance];
  }
  if (out.size() != size) Reject(path, "the compressed PCD data is truncated or damaged");
  return out;
}

// Derived: LZF writes at most 264 bytes for three.
constexpr size_t kMaxLzfRatio = 88;

std::vector<Vec3> ReadCompressed(const fs::path& path, const Header& header,
                                 std::string_view body) {
  std::array<uint32_t, 2> sizes{};
  if (body.size() < sizeof(sizes)) Reject(path, "truncated: no compressed data");
  std::memcpy(sizes.data(), body.data(), sizeof(sizes));
  body.remove_prefix(sizeof(sizes));
  if (body.size() < sizes[0] || sizes[1] / kMaxLzfRatio > sizes[0]) {
    Reject(path, "the compressed PCD data is truncated or damaged");
  }
  return ReadBinary(path, header, DecompressLzf(path, body.substr(0, sizes[0]), sizes[1]), true);
}

}  // namespace

bool IsPcd(std::string_view content) {
  return content.starts_with("# .PCD") || content.starts_with("VERSION ");
}

std::vector<Vec3> ReadPcdPoints(const fs::path& path, std::string_view content) {
  LineScanner lines(content);
  const Header header = ReadHeader(path, lines);
  if (header.data == "ascii") return ReadAscii(path, header, lines);
  if (header.data == "binary") return ReadBinary(path, header, lines.rest(), false);
  if (header.data == "binary_compressed") return ReadCompressed(path, header, lines.rest());
  Reject(path, fmt::format("PCD data '{}' is not known; ascii, binary or binary_compressed is "
                           "expected",
                           header.data));
}

}  // namespace curvefusion
