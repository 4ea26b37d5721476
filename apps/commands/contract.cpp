#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/commands/command.h"
#include "apps/output_folder.h"
#include "apps/output_guard.h"
#include "apps/report.h"
#include "graph/contraction/cloud_curves.h"
#include "graph/io/graph_io.h"
#include "kernel/cancellation.h"
#include "kernel/cloud_io.h"

namespace curvefusion {

namespace {

struct ContractArguments {
  std::filesystem::path cloud;
  std::filesystem::path output;
  std::string method = "auto";
  double scale = 0;             // metres per unit of the file; 0 = from the cloud's extent
  double neighbourhood_mm = 0;  // 0 = from the cloud
  double radius_mm = 0;         // 0 = unknown
  RunOptions run;
};

CloudCurveOptions OptionsOf(const ContractArguments& arguments) {
  return {CloudMethodNamed(arguments.method), arguments.neighbourhood_mm * kMillimetre,
          arguments.radius_mm * kMillimetre};
}

// A wire object of more than this is no object but a unit other than the metre.
constexpr double kLargestObject = 10;

// Metres per unit: millimetres where the cloud would be too large for metres.
double GuessedScale(const ObservedPoints& points) {
  return RobustExtent(points).maxCoeff() <= kLargestObject ? 1 : kMillimetre;
}

int RunContract(const ContractArguments& arguments) {
  LimitThreads(arguments.run);
  RequireApart({arguments.cloud}, arguments.output);
  MakeFolderOf(arguments.output);
  CheckSkeletonFormat(arguments.output);
  ObservedPoints points = ReadCloud(arguments.cloud);
  const double scale = arguments.scale > 0 ? arguments.scale : GuessedScale(points);
  if (scale != 1 && arguments.scale <= 0 && !arguments.run.quiet) {
    fmt::print("Coordinates are taken as millimetres (--scale 1 if they are metres)\n");
  }
  for (Vec3& position : points.positions) position *= scale;
  const SkeletonGraph graph = CurvesOfCloud(points, OptionsOf(arguments));
  ThrowIfCancelled();
  if (graph.empty()) {
    fmt::print(stderr,
               "curvefusion: no curve in the {} points of {}; is --scale right (metres per unit "
               "of the file)?\n",
               points.size(), arguments.cloud.string());
    return kNothingThin;
  }
  const std::vector<std::string> losses = ExportSkeleton(arguments.output, graph);
  if (!arguments.run.quiet) {
    fmt::print("Found {}\n  skeleton  {}\n", FiguresLine(MeasureGraph(graph)),
               arguments.output.string());
    for (const std::string& loss : losses) fmt::print("  {}\n", loss);
  }
  return 0;
}

}  // namespace

void AddContractCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("contract", "Contract a point cloud of thin structures to its curves");
  const auto arguments = std::make_shared<ContractArguments>();
  command->add_option("CLOUD", arguments->cloud, "PLY, PCD or XYZ file")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "The skeleton to write, by extension: .json, .graphml, .swc, .ply, .obj, .dxf, "
                   ".svg or .usda")
      ->required();
  command
      ->add_option("--scale", arguments->scale,
                   "Metres per unit of the file, 0.001 for mm; otherwise metres, or mm where the "
                   "cloud would be larger than 10 m")
      ->check(PositiveNumber());
  command
      ->add_option(
          "--method", arguments->method,
          "ridge: density ridges, for wires of 2 to 12 mm, also close ones; l1: the paper\'s L1 "
          "axis, for any size; auto (default): by the thickness of the cloud")
      ->check(CLI::IsMember({"auto", "ridge", "l1"}));
  command
      ->add_option("--neighbourhood", arguments->neighbourhood_mm,
                   "First radius of l1 in mm, about three times the wires' thickness; otherwise "
                   "from the cloud")
      ->check(PositiveNumber());
  command
      ->add_option("--radius", arguments->radius_mm,
                   "Radius of the wires in mm, stored with the curves; where the cloud has viewing "
                   "rays, its points are moved from the surface to the axis")
      ->check(PositiveNumber());
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Example:\n  curvefusion contract cloud.ply -o skeleton.json\n"
      "  curvefusion contract cloud_mm.xyz -o skeleton.json --scale 0.001 --radius 2.5\n"
      "  curvefusion contract tree.ply -o tree.json --method l1");
  command->callback([arguments, &exit_code] { exit_code = RunContract(*arguments); });
}

}  // namespace curvefusion
