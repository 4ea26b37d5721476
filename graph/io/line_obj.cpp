#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "graph/io/graph_formats.h"
#include "graph/io/indexed_curves.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

// Where a message points to.
struct Place {
  const std::string& source;
  size_t line;
};

[[noreturn]] void Fail(const Place& place, const std::string& what) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: line {}: {}", place.source, place.line, what));
}

Vec3 ParseVertex(std::string_view words, const Place& place) {
  Vec3 position;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = NextWord(words);
    const std::optional<double> value = ParseNumber(word);
    if (!value || !std::isfinite(*value))
      Fail(place, fmt::format("'{}' is not a finite number; a vertex needs three", word));
    position[k] = *value;
  }
  return position;
}

// Vertices count from 1, or backwards from the last one; "7/2" means vertex 7.
std::vector<int> ParseLine(std::string_view words, int64_t vertex_count, const Place& place) {
  std::vector<int> curve;
  for (std::string_view word = NextWord(words); !word.empty(); word = NextWord(words)) {
    const std::optional<int64_t> number = ParseInteger(word.substr(0, word.find('/')));
    if (!number || *number == 0 || *number > vertex_count || *number < -vertex_count)
      Fail(place, fmt::format("there is no vertex '{}' among {}", word, vertex_count));
    curve.push_back(static_cast<int>(*number > 0 ? *number - 1 : vertex_count + *number));
  }
  if (curve.size() < 2) Fail(place, "a line needs two vertices");
  return curve;
}

}  // namespace

FormatLosses WriteLineObj(const std::filesystem::path& path, const SkeletonGraph& graph) {
  const IndexedCurves curves = CurvesOf(graph);
  std::string text = "# Curves of CurveFusion, metres\n";
  for (const Vec3& p : curves.vertices) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const std::vector<int>& curve : curves.curves) {
    text += "l";
    for (const int vertex : curve) text += fmt::format(" {}", vertex + 1);
    text += "\n";
  }
  WriteBytesAtomically(path, text);
  return LossesOfIndexedCurves(graph, false);
}

SkeletonGraph ReadLineObj(const std::string& text, const std::string& source) {
  IndexedCurves curves;
  LineScanner lines(text);
  for (std::string_view line; lines.Next(line);) {
    const Place place{source, lines.number()};
    const std::string_view keyword = NextWord(line);
    if (keyword == "v") curves.vertices.push_back(ParseVertex(line, place));
    if (keyword == "l")
      curves.curves.push_back(ParseLine(line, static_cast<int64_t>(curves.vertices.size()), place));
  }
  return GraphOf(curves, source);
}

}  // namespace curvefusion
