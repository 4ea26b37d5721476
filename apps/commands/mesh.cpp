#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/commands/command.h"
#include "apps/interrupt.h"
#include "apps/output_folder.h"
#include "apps/set_radius.h"
#include "apps/tube_warnings.h"
#include "graph/graph_io.h"
#include "kernel/error.h"
#include "kernel/parallel.h"
#include "meshing/mesh_io.h"
#include "meshing/tubes.h"

namespace curvefusion {

namespace {

struct MeshArguments {
  std::filesystem::path skeleton;
  std::filesystem::path output;
  double radius_mm = 0;  // 0 = the radii of the file
  std::string unit = "m";
  bool check = false;
  TubeOptions tubes;
  RunOptions run;
};

// Examines the file as another program would find it. Returns whether it is sound.
bool CheckFile(const std::filesystem::path& path) {
  const WatertightReport report = ExamineMesh(ReadMesh(path));
  fmt::print("  vertices {}, faces {}, parts {}, genus {}\n", report.vertices, report.faces,
             report.components, report.genus);
  fmt::print("  {}\n", report.IsWatertight() ? "watertight" : report.Defects());
  return report.IsWatertight();
}

int RunMesh(const MeshArguments& arguments) {
  const ThreadLimit limit(arguments.run.threads);
  SkeletonGraph skeleton = ReadSkeleton(arguments.skeleton);
  MakeFolderOf(arguments.output);
  if (arguments.radius_mm > 0) SetRadius(arguments.radius_mm * kMillimetre, skeleton);
  const TubeMesh tubes = BuildTubes(skeleton, arguments.tubes);
  ThrowIfInterrupted();
  const MeshUnit unit = arguments.unit == "mm" ? MeshUnit::kMillimetres : MeshUnit::kMetres;
  WriteMesh(arguments.output, ToTriangleMesh(tubes.surface), {.unit = unit});
  if (!arguments.run.quiet) {
    fmt::print("Wrote {} ({})\n", arguments.output.string(), arguments.unit);
    for (const std::string& warning : TubeWarnings(skeleton, tubes, arguments.tubes)) {
      fmt::print("  warning: {}\n", warning);
    }
  }
  const bool sound = !arguments.check || CheckFile(arguments.output);
  return sound ? 0 : ExitCode(ErrorKind::kBadInput);
}

}  // namespace

void AddMeshCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("mesh", "Make a watertight mesh of tubes around the curves of a skeleton");
  const auto arguments = std::make_shared<MeshArguments>();
  command->add_option("SKELETON", arguments->skeleton, "A skeleton.json")->required();
  command->add_option("-o,--output", arguments->output, "A .ply, .obj or .stl file to write")
      ->required();
  command
      ->add_option("--radius", arguments->radius_mm,
                   "Radius of all tubes in mm, in place of those of the skeleton")
      ->check(CLI::PositiveNumber);
  command->add_option("--sides", arguments->tubes.sides, "Corners of a tube's cross-section")
      ->check(CLI::Range(8, 64));
  command->add_option("--unit", arguments->unit, "Unit of the coordinates: m (default) or mm")
      ->check(CLI::IsMember({"m", "mm"}));
  command->add_flag("--check", arguments->check, "Read the file back and tell what it is");
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Example:\n  curvefusion mesh result/skeleton.json -o wires.ply\n"
      "  curvefusion mesh result/skeleton.json -o print.stl --unit mm --radius 3 --check");
  command->callback([arguments, &exit_code] { exit_code = RunMesh(*arguments); });
}

}  // namespace curvefusion
