#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/commands/command.h"
#include "apps/graph_figures.h"
#include "graph/graph_io.h"

namespace curvefusion {

namespace {

struct GraphArguments {
  std::filesystem::path skeleton;
  bool info = false;
  std::filesystem::path lines;
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

int RunGraph(const GraphArguments& arguments) {
  const SkeletonGraph graph = ReadSkeleton(arguments.skeleton);
  if (!arguments.lines.empty()) WriteSkeletonLines(arguments.lines, graph);
  if (arguments.info || arguments.lines.empty()) PrintInfo(graph);
  return 0;
}

}  // namespace

void AddGraphCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("graph", "Look into a skeleton.json or export its lines");
  const auto arguments = std::make_shared<GraphArguments>();
  command->add_option("SKELETON", arguments->skeleton, "A skeleton.json")->required();
  command->add_flag("--info", arguments->info, "Print its figures (what happens without options)");
  command->add_option("--lines", arguments->lines, "Write its curves as a PLY file of lines");
  command->footer(
      "Example:\n  curvefusion graph result/skeleton.json --info\n"
      "  curvefusion graph result/skeleton.json --lines curves.ply");
  command->callback([arguments, &exit_code] { exit_code = RunGraph(*arguments); });
}

}  // namespace curvefusion
