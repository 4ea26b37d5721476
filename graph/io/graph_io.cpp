#include "graph/io/graph_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "graph/io/graph_formats.h"
#include "graph/validate.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/file_extension.h"
#include "kernel/parallel.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

struct GraphFormat {
  const char* extension;
  FormatLosses (*write)(const std::filesystem::path&, const SkeletonGraph&);
  SkeletonGraph (*read)(const std::string& text, const std::string& source);  // null = not read
  void (*write_splines)(const std::filesystem::path&, const FittedCurves&) = nullptr;
};

FormatLosses WriteJson(const std::filesystem::path& path, const SkeletonGraph& graph) {
  WriteSkeleton(path, graph);
  return {};
}

// Chosen. By extension: what writes curves, what reads them, what writes splines.
constexpr GraphFormat kFormats[] = {
    {".json", WriteJson, SkeletonFromJson},
    {".graphml", WriteGraphml, ReadGraphml},
    {".swc", WriteSwc, ReadSwc},
    {".ply", WriteLinePly, ReadLinePly},
    {".obj", WriteLineObj, ReadLineObj},
    {".dxf", WriteDxf, nullptr, WriteDxfSplines},
    {".svg", WriteSvg, nullptr},
    {".usda", WriteUsda, nullptr, WriteUsdaSplines},
    {".step", nullptr, nullptr, WriteStepSplines},
};

// Null where no format has it.
const GraphFormat* FormatOf(const std::filesystem::path& path) {
  const std::string extension = LowerCaseExtension(path);
  const auto found =
      std::find_if(std::begin(kFormats), std::end(kFormats),
                   [&](const GraphFormat& format) { return extension == format.extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

// In the smallest unit that is written, too: a value near the end of the range may not fit.
void RequireFiniteValues(const SkeletonGraph& graph, const std::string& target) {
  constexpr double kSmallestUnit = 1e-6;  // derived: the micrometres of SWC
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
  WriteBytesAtomically(path, text);
}

void CheckSkeletonFormat(const std::filesystem::path& path) {
  const GraphFormat* format = FormatOf(path);
  if (format != nullptr && format->write != nullptr) return;
  throw Error(
      ErrorKind::kUsage,
      fmt::format("{}: a graph file ends in .json, .graphml, .swc, .ply, .obj, .dxf, .svg or "
                  ".usda, not '{}'{}",
                  path.string(), path.extension().string(),
                  format != nullptr ? "; .step needs --fit" : ""));
}

void CheckSplineFormat(const std::filesystem::path& path) {
  const GraphFormat* format = FormatOf(path);
  if (format != nullptr && format->write_splines != nullptr) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: a file of splines ends in .dxf, .usda or .step, not '{}'",
                          path.string(), path.extension().string()));
}

FormatLosses LossesOfCurves(const SkeletonGraph& graph, bool keeps_radii) {
  bool has_radii = false, has_observations = false;
  for (const EdgeId id : graph.Edges()) {
    has_radii = has_radii || !graph.edge(id).radii.empty();
    has_observations = has_observations || !graph.edge(id).observations.empty();
  }
  int isolated = 0;
  for (const NodeId node : graph.Nodes()) isolated += graph.Degree(node) == 0 ? 1 : 0;
  FormatLosses losses;
  if (graph.edge_count() > 0) losses.emplace_back("curves meet by coordinates only, not by nodes");
  if (isolated > 0) losses.push_back(fmt::format("{} nodes without edges are left out", isolated));
  if (has_radii && !keeps_radii) losses.emplace_back("radii are not kept");
  if (has_observations) losses.emplace_back("observation counts are not kept");
  return losses;
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

SplineFigures ExportSplines(const std::filesystem::path& path, const SkeletonGraph& graph,
                            double tolerance) {
  CheckSplineFormat(path);
  RequireFiniteValues(graph, path.string());
  const std::vector<EdgeId> edges = graph.Edges();
  FittedCurves fitted(edges.size());
  ParallelFor(0, static_cast<int64_t>(edges.size()), 1, [&](int64_t i) {
    const EdgeId id = edges[static_cast<size_t>(i)];
    fitted[static_cast<size_t>(i)] = {id, FitSpline(graph.edge(id), tolerance)};
  });
  SplineFigures figures;
  for (const auto& [id, spline] : fitted) {
    figures.control_points += spline.points.size();
    figures.polyline_points += graph.edge(id).points.size();
    figures.deviation = std::max(figures.deviation, spline.deviation);
  }
  WriteFileAtomically(path, [&](const std::filesystem::path& temporary) {
    FormatOf(path)->write_splines(temporary, fitted);
  });
  return figures;
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
