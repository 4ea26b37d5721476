#include "graph/io/graph_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>

#include "graph/io/graph_formats.h"
#include "graph/validate.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

struct GraphFormat {
  const char* extension;
  FormatLosses (*write)(const std::filesystem::path&, const SkeletonGraph&);
  SkeletonGraph (*read)(const std::string& text, const std::string& source);  // null = not read
};

FormatLosses WriteJson(const std::filesystem::path& path, const SkeletonGraph& graph) {
  WriteSkeleton(path, graph);
  return {};
}

constexpr GraphFormat kFormats[] = {
    {".json", WriteJson, SkeletonFromJson},
    {".graphml", WriteGraphml, ReadGraphml},
    {".swc", WriteSwc, ReadSwc},
    {".ply", WriteLinePly, ReadLinePly},
    {".obj", WriteLineObj, ReadLineObj},
    {".dxf", WriteDxf, nullptr},
};

// Null where no format has it.
const GraphFormat* FormatOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found =
      std::find_if(std::begin(kFormats), std::end(kFormats),
                   [&](const GraphFormat& format) { return extension == format.extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

// In the smallest unit that is written, too: a value near the end of the range may not fit.
void RequireFiniteValues(const SkeletonGraph& graph, const std::string& target) {
  constexpr double kSmallestUnit = 1e-6;
  const auto finite = [](double value) { return std::isfinite(value / kSmallestUnit); };
  bool sound = true;
  for (const NodeId node : graph.Nodes())
    sound = sound && (graph.position(node) / kSmallestUnit).allFinite();
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    for (const Vec3& p : edge.points) sound = sound && (p / kSmallestUnit).allFinite();
    sound = sound && std::all_of(edge.radii.begin(), edge.radii.end(), finite);
  }
  if (sound) return;
  throw Error(ErrorKind::kBadInput,
              target + ": a value of the skeleton is not finite, or hardly; not written");
}

}  // namespace

void WriteSkeleton(const std::filesystem::path& path, const SkeletonGraph& graph) {
  const std::string text = SkeletonToJson(graph);
  WriteStreamAtomically(path, [&text](std::ostream& stream) { stream << text; });
}

void CheckSkeletonFormat(const std::filesystem::path& path) {
  if (FormatOf(path) != nullptr) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: a graph file ends in .json, .graphml, .swc, .ply, .obj or .dxf, "
                          "not '{}'",
                          path.string(), path.extension().string()));
}

std::vector<std::string> ExportSkeleton(const std::filesystem::path& path,
                                        const SkeletonGraph& graph) {
  CheckSkeletonFormat(path);
  const GraphFormat* format = FormatOf(path);
  RequireFiniteValues(graph, path.string());
  FormatLosses losses;
  WriteFileAtomically(path, [&](const std::filesystem::path& temporary) {
    losses = format->write(temporary, graph);
  });
  return losses;
}

SkeletonGraph ReadSkeleton(const std::filesystem::path& path) {
  const GraphFormat* format = path.has_extension() ? FormatOf(path) : &kFormats[0];
  if (format == nullptr || format->read == nullptr) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: a graph is read from .json, .graphml, .swc, .ply or .obj, not "
                            "'{}'",
                            path.string(), path.extension().string()));
  }
  SkeletonGraph graph = format->read(ReadFile(path), path.string());
  RequireWithinBounds(graph, path.string());
  return graph;
}

}  // namespace curvefusion
