#include <fmt/format.h>

#include <algorithm>
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

struct Element {
  std::string name;
  int64_t count = 0;
  std::vector<std::string> properties;
};

// Reads the elements of an ASCII PLY, one a line, into curves.
class LinePlyReader {
 public:
  LinePlyReader(std::string_view text, const std::string& source) : lines_(text), source_(source) {}

  IndexedCurves Read() {
    for (const Element& element : Header()) {
      for (int64_t i = 0; i < element.count; ++i) {
        std::string_view line;
        if (!lines_.Next(line))
          Fail(fmt::format("ends in {} {} of {}", element.name, i, element.count));
        if (element.name == "vertex") AddVertex(Values(line, element), element);
        if (element.name == "edge") AddEdge(Values(line, element), element);
      }
    }
    return std::move(curves_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: line {}: {}", source_, lines_.number(), what));
  }

  std::vector<Element> Header() {
    std::string_view line;
    if (!lines_.Next(line) || line != "ply") Fail("a PLY file begins with 'ply'");
    std::vector<Element> elements;
    while (lines_.Next(line)) {
      const std::string_view keyword = NextWord(line);
      if (keyword == "end_header") return elements;
      if (keyword == "format" && NextWord(line) != "ascii")
        Fail("only ascii PLY is read as lines; save it as such");
      if (keyword == "element") elements.push_back(ParseElement(line));
      if (keyword == "property") AddProperty(line, elements);
    }
    Fail("the PLY header does not end");
  }

  Element ParseElement(std::string_view words) const {
    Element element{std::string(NextWord(words)), 0, {}};
    const std::optional<int64_t> count = ParseInteger(NextWord(words));
    if (!count || *count < 0 || *count > INT32_MAX) Fail("an element needs a name and a count");
    element.count = *count;
    return element;
  }

  void AddProperty(std::string_view words, std::vector<Element>& elements) const {
    if (elements.empty()) Fail("a property before any element");
    Element& element = elements.back();
    const bool is_list = NextWord(words) == "list";
    if (is_list && (element.name == "vertex" || element.name == "edge"))
      Fail(fmt::format("a list in the element {} is not read", element.name));
    element.properties.emplace_back(NextWord(words));
  }

  std::vector<double> Values(std::string_view line, const Element& element) const {
    std::vector<double> values;
    for (const std::string& property : element.properties) {
      const std::string_view word = NextWord(line);
      const std::optional<double> value = ParseNumber(word);
      if (!value || !std::isfinite(*value))
        Fail(fmt::format("{} is '{}', not a finite number", property, word));
      values.push_back(*value);
    }
    return values;
  }

  // The value of a property; nothing where the element does not have it.
  static std::optional<double> Find(const std::vector<double>& values, const Element& element,
                                    const char* property) {
    const auto found = std::find(element.properties.begin(), element.properties.end(), property);
    if (found == element.properties.end()) return std::nullopt;
    return values[static_cast<size_t>(found - element.properties.begin())];
  }

  void AddVertex(const std::vector<double>& values, const Element& element) {
    Vec3 position;
    for (int k = 0; k < 3; ++k) {
      constexpr const char* kAxes[] = {"x", "y", "z"};
      const std::optional<double> value = Find(values, element, kAxes[k]);
      if (!value) Fail(fmt::format("the vertices have no property {}", kAxes[k]));
      position[k] = *value;
    }
    curves_.vertices.push_back(position);
    const std::optional<double> radius = Find(values, element, "radius");
    if (!radius) return;
    if (*radius < 0)
      Fail(fmt::format("radius is {}, it must be positive, or 0 = unknown", *radius));
    curves_.radii.push_back(*radius);
  }

  void AddEdge(const std::vector<double>& values, const Element& element) {
    std::vector<int> segment;
    for (const char* property : {"vertex1", "vertex2"}) {
      const std::optional<double> value = Find(values, element, property);
      if (!value) Fail(fmt::format("the edges have no property {}", property));
      const auto count = static_cast<double>(curves_.vertices.size());
      if (*value != std::floor(*value) || *value < 0 || *value >= count)
        Fail(fmt::format("{} is {}, but there are {} vertices", property, *value, count));
      segment.push_back(static_cast<int>(*value));
    }
    curves_.curves.push_back(std::move(segment));
  }

  LineScanner lines_;
  const std::string& source_;
  IndexedCurves curves_;
};

}  // namespace

FormatLosses WriteLinePly(const std::filesystem::path& path, const SkeletonGraph& graph) {
  const IndexedCurves curves = CurvesOf(graph);
  size_t segments = 0;
  for (const std::vector<int>& curve : curves.curves) segments += curve.size() - 1;
  const bool has_radii = !curves.radii.empty();
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\n{}element edge {}\nproperty int vertex1\nproperty int vertex2\n"
      "end_header\n",
      curves.vertices.size(), has_radii ? "property double radius\n" : "", segments);
  for (size_t v = 0; v < curves.vertices.size(); ++v) {
    const Vec3& p = curves.vertices[v];
    text += fmt::format("{} {} {}", p.x(), p.y(), p.z());
    text += has_radii ? fmt::format(" {}\n", curves.radii[v]) : "\n";
  }
  for (const std::vector<int>& curve : curves.curves)
    for (size_t i = 1; i < curve.size(); ++i)
      text += fmt::format("{} {}\n", curve[i - 1], curve[i]);
  WriteBytesAtomically(path, text);
  return LossesOfIndexedCurves(graph, true);
}

SkeletonGraph ReadLinePly(const std::string& text, const std::string& source) {
  return GraphOf(LinePlyReader(text, source).Read(), source);
}

}  // namespace curvefusion
