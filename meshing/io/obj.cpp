#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <vector>

#include "kernel/error.h"
#include "meshing/io/mesh_formats.h"

namespace curvefusion {

namespace {

[[noreturn]] void ThrowBadLine(const std::string& name, int line, const std::string& what) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: line {}: {}", name, line, what));
}

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t end = 0;;) {
    const size_t start = line.find_first_not_of(" \t\r", end);
    if (start == std::string_view::npos) return words;
    end = std::min(line.find_first_of(" \t\r", start), line.size());
    words.push_back(line.substr(start, end - start));
  }
}

// The number a word begins with; false where it does not.
template <class T>
bool Parse(std::string_view word, T& value) {
  return std::from_chars(word.data(), word.data() + word.size(), value).ec == std::errc();
}

Vec3f ParseVertex(const std::vector<std::string_view>& words, const std::string& name, int line) {
  Vec3f v = Vec3f::Zero();
  if (words.size() < 4 || !Parse(words[1], v.x()) || !Parse(words[2], v.y()) ||
      !Parse(words[3], v.z())) {
    ThrowBadLine(name, line, "a vertex needs three numbers");
  }
  return v;
}

// Indices count from 1, or backwards from the last vertex; "7/2/3" means vertex 7.
std::array<int, 3> ParseFace(const std::vector<std::string_view>& words, int vertex_count,
                             const std::string& name, int line) {
  if (words.size() != 4) {
    ThrowBadLine(name, line,
                 fmt::format("a face of {} corners; only triangles are read", words.size() - 1));
  }
  std::array<int, 3> triangle{};
  for (size_t k = 0; k < 3; ++k) {
    int index = 0;
    if (!Parse(words[k + 1], index)) ThrowBadLine(name, line, "a face needs vertex numbers");
    triangle[k] = index < 0 ? vertex_count + index : index - 1;
  }
  return triangle;
}

}  // namespace

void WriteObj(const TriangleMesh& mesh, std::ostream& stream) {
  fmt::memory_buffer text;
  for (const Vec3f& v : mesh.vertices) {
    fmt::format_to(std::back_inserter(text), "v {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", a + 1, b + 1, c + 1);
  }
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
}

TriangleMesh ReadObj(std::istream& stream, const std::string& name) {
  TriangleMesh mesh;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::vector<std::string_view> words = Words(line);
    if (words.empty()) continue;
    if (words[0] == "v") mesh.vertices.push_back(ParseVertex(words, name, number));
    if (words[0] == "f") {
      mesh.triangles.push_back(
          ParseFace(words, static_cast<int>(mesh.vertices.size()), name, number));
    }
  }
  return mesh;
}

}  // namespace curvefusion
