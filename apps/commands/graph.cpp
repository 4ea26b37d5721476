#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "apps/commands/command.h"
#include "apps/output_folder.h"
#include "apps/output_guard.h"
#include "graph/graph_figures.h"
#include "graph/intersections.h"
#include "graph/io/cut_list.h"
#include "graph/io/graph_io.h"
#include "graph/smoothing.h"
#include "graph/validate.h"
#include "kernel/cancellation.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

struct GraphArguments {
  std::filesystem::path graph;
  bool info = false;
  bool validate = false;
  double proximity_mm = kProximity / kMillimetre;
  std::vector<int> removed;  // numbers of curves, as on the report page
  double resolve_mm = 0;     // 0 = do not
  double smooth = 0;         // lambda; 0 = do not
  std::filesystem::path output;
  std::filesystem::path convert;
  double fit_mm = 0;  // 0 = --convert writes polylines
  std::filesystem::path cut_list;
  double bend_tolerance_mm = 1;  // chosen: half the error of a wire's axis in a good scan
  RunOptions run;
};

void PrintInfo(const SkeletonGraph& graph) {
  const GraphFigures figures = MeasureGraph(graph);
  fmt::print("nodes       {}\nedges       {}\njunctions   {}\nfree ends   {}\n", figures.nodes,
             figures.edges, figures.junctions, figures.free_ends);
  fmt::print("components  {}\ncycles      {}\nlength      {:.1f} mm\n\n", figures.components,
             figures.cycles, figures.length / kMillimetre);
  fmt::print("{:>6}  {:>6}  {:>6}  {:>11}  {:>13}\n", "edge", "from", "to", "length (mm)",
             "diameter (mm)");
  const std::vector<EdgeId> edges = graph.Edges();
  for (size_t i = 0; i < edges.size(); ++i) {
    const double diameter = 2 * figures.edge_radius[i] / kMillimetre;
    fmt::print("{:>6}  {:>6}  {:>6}  {:>11.1f}  {:>13}\n", edges[i], graph.edge(edges[i]).nodes[0],
               graph.edge(edges[i]).nodes[1], figures.edge_length[i] / kMillimetre,
               diameter > 0 ? fmt::format("{:.2f}", diameter) : "unknown");
  }
}

// Prints everything that is wrong. Returns whether nothing is.
bool PrintViolations(const SkeletonGraph& graph, const GraphArguments& arguments) {
  const std::vector<std::string> violations =
      Violations(graph, arguments.proximity_mm * kMillimetre);
  for (const std::string& violation : violations) fmt::print("{}\n", violation);
  if (violations.empty()) {
    if (!arguments.run.quiet)
      fmt::print("{} is valid (curves at least {} mm apart)\n", arguments.graph.string(),
                 arguments.proximity_mm);
    return true;
  }
  fmt::print(stderr, "curvefusion: {}: {} violations\n", arguments.graph.string(),
             violations.size());
  return false;
}

void Export(const std::filesystem::path& path, const SkeletonGraph& graph, bool quiet) {
  ThrowIfCancelled();
  MakeFolderOf(path);
  const std::vector<std::string> losses = ExportSkeleton(path, graph);
  if (quiet) return;
  fmt::print("Wrote {}\n", path.string());
  for (const std::string& loss : losses) fmt::print("  {}\n", loss);
}

void ExportFitted(const GraphArguments& arguments, const SkeletonGraph& graph) {
  ThrowIfCancelled();
  MakeFolderOf(arguments.convert);
  const SplineFigures figures =
      ExportSplines(arguments.convert, graph, arguments.fit_mm * kMillimetre);
  if (arguments.run.quiet) return;
  fmt::print(
      "Wrote {}\n  {} cubic B-splines of {} control points for polylines of {} points, "
      "within {:.3g} mm\n",
      arguments.convert.string(), graph.edge_count(), figures.control_points,
      figures.polyline_points, figures.deviation / kMillimetre);
}

void ExportCutList(const GraphArguments& arguments, const SkeletonGraph& graph) {
  MakeFolderOf(arguments.cut_list);
  WriteCutList(arguments.cut_list, graph, arguments.bend_tolerance_mm * kMillimetre);
  if (!arguments.run.quiet) fmt::print("Wrote {}\n", arguments.cut_list.string());
}

// Takes curves out; those that met there without the removed ones are one curve afterwards.
void RemoveCurves(const GraphArguments& arguments, SkeletonGraph& graph) {
  if (arguments.removed.empty()) return;
  const std::vector<EdgeId> edges = graph.Edges();
  for (const int number : std::set<int>(arguments.removed.begin(), arguments.removed.end())) {
    if (number < 0 || number >= static_cast<int>(edges.size())) {
      throw Error(ErrorKind::kUsage, fmt::format("--remove {}: {} has {} curves, counted from 0",
                                                 number, arguments.graph.string(), edges.size()));
    }
    graph.RemoveEdge(edges[static_cast<size_t>(number)]);
  }
  graph.RemoveIsolatedNodes();
  graph.DissolveDegree2Nodes();
}

// Nodes and curves with the numbers that they get in a file.
SkeletonGraph Renumbered(const SkeletonGraph& graph) {
  SkeletonGraph renumbered;
  Append(graph, renumbered);
  return renumbered;
}

void CheckUsage(const GraphArguments& arguments) {
  const bool changes =
      !arguments.removed.empty() || arguments.resolve_mm > 0 || arguments.smooth > 0;
  if (changes && arguments.output.empty())
    throw Error(ErrorKind::kUsage,
                "--remove, --resolve and --smooth need -o: where to write the result");
  if (!changes && !arguments.output.empty())
    throw Error(ErrorKind::kUsage,
                "-o takes the result of --remove, --resolve or --smooth; --convert writes the "
                "graph as it is");
  if (!arguments.output.empty()) CheckSkeletonFormat(arguments.output);
  if (arguments.fit_mm > 0) {
    CheckSplineFormat(arguments.convert);
  } else if (!arguments.convert.empty()) {
    CheckSkeletonFormat(arguments.convert);
  }
  if (!arguments.cut_list.empty() && arguments.cut_list.extension() != ".csv") {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: a cut list is a .csv file, not '{}'", arguments.cut_list.string(),
                            arguments.cut_list.extension().string()));
  }
}

int RunGraph(const GraphArguments& arguments) {
  CheckUsage(arguments);
  LimitThreads(arguments.run);
  RequireApart({arguments.graph}, arguments.convert);
  RequireApart({arguments.graph, arguments.convert}, arguments.output);
  RequireApart({arguments.graph, arguments.convert, arguments.output}, arguments.cut_list);
  SkeletonGraph graph = ReadSkeleton(arguments.graph);
  const bool valid = !arguments.validate || PrintViolations(graph, arguments);
  if (arguments.fit_mm > 0) {
    ExportFitted(arguments, graph);
  } else if (!arguments.convert.empty()) {
    Export(arguments.convert, graph, arguments.run.quiet);
  }
  RemoveCurves(arguments, graph);
  if (arguments.resolve_mm > 0) ResolveIntersections(graph, arguments.resolve_mm * kMillimetre);
  if (arguments.smooth > 0) {
    SmoothingOptions options;
    options.lambda = arguments.smooth;
    graph = SmoothGraph(graph, options);
  }
  if (!arguments.output.empty()) {
    graph = Renumbered(graph);
    Export(arguments.output, graph, arguments.run.quiet);
  }
  if (!arguments.cut_list.empty()) ExportCutList(arguments, graph);
  const bool only_info = !arguments.validate && arguments.convert.empty() &&
                         arguments.output.empty() && arguments.cut_list.empty();
  if (arguments.info || only_info) PrintInfo(graph);
  return valid ? 0 : ExitCode(ErrorKind::kBadInput);
}

}  // namespace

void AddGraphCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("graph", "Inspect, validate, repair, smooth or convert a skeleton graph");
  const auto arguments = std::make_shared<GraphArguments>();
  command
      ->add_option("FILE", arguments->graph,
                   "A .json, .graphml, .ply or .obj file (in metres) or .swc (in micrometres)")
      ->required();
  command->add_flag("--info", arguments->info,
                    "Print figures in mm, of the result where the graph is changed (the default)");
  CLI::Option* const validate = command->add_flag(
      "--validate", arguments->validate,
      "Print everything that is wrong with the file and where; exit code 3 if anything is");
  command
      ->add_option("--proximity", arguments->proximity_mm,
                   "With --validate: how near in mm curves may come without meeting (1)")
      ->check(PositiveNumber())
      ->needs(validate);  // by its name CLI11 cannot look it up without memory
  command
      ->add_option("--remove", arguments->removed,
                   "Take these curves out, by their numbers on the report page and in --info: 3,17")
      ->delimiter(',');
  command
      ->add_option("--resolve", arguments->resolve_mm,
                   "Make junctions where curves cross or come within this distance in mm, and "
                   "merge what runs side by side")
      ->check(PositiveNumber());
  command
      ->add_option("--smooth", arguments->smooth,
                   "Resample to 1 mm and smooth, after --resolve; the value weighs smoothness "
                   "against the data (lambda, without unit; 60 in the paper)")
      ->check(PositiveNumber());
  command->add_option("-o,--output", arguments->output,
                      "Where --remove, --resolve and --smooth write; formats as for --convert");
  CLI::Option* const convert = command->add_option(
      "--convert", arguments->convert,
      "Write the graph as it was read, by extension: .json, .graphml, .ply or .obj lines (metres), "
      ".swc (micrometres), .dxf polylines (mm), .svg views (mm), .usda curves (metres); prints "
      "what "
      "the format does not keep");
  command
      ->add_option(
          "--fit", arguments->fit_mm,
          "With --convert to .dxf, .usda or .step: every edge as one cubic B-spline within "
          "this distance in mm, such as 0.5 or 0.5mm")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"mm", 1.0}}))
      ->check(CLI::PositiveNumber)
      ->needs(convert);
  CLI::Option* const cut_list = command->add_option(
      "--cut-list", arguments->cut_list,
      "Write a .csv that tells how to cut and bend the wire of every edge (mm, degrees), of the "
      "result where the graph is changed");
  command
      ->add_option("--bend-tolerance", arguments->bend_tolerance_mm,
                   "With --cut-list: how far in mm the bent wire may leave the curve (1)")
      ->check(PositiveNumber())
      ->needs(cut_list);
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Example:\n  curvefusion graph result/skeleton.json --info\n"
      "  curvefusion graph result/skeleton.json --validate --proximity 3\n"
      "  curvefusion graph result/skeleton.json --remove 3,17 -o edited.json\n"
      "  curvefusion graph result/skeleton.json --resolve 3 --smooth 60 -o mended.json\n"
      "  curvefusion graph result/skeleton.json --convert wires.dxf\n"
      "  curvefusion graph result/skeleton.json --fit 0.5mm --convert wires.step\n"
      "  curvefusion graph result/skeleton.json --cut-list wires.csv");
  command->callback([arguments, &exit_code] { exit_code = RunGraph(*arguments); });
}

}  // namespace curvefusion
