#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/command.h"
#include "apps/output_folder.h"
#include "apps/output_guard.h"
#include "fusion/solid_parts/solid_parts.h"
#include "graph/io/graph_io.h"
#include "graph/set_radius.h"
#include "kernel/angle.h"
#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "meshing/hybrid_mesh.h"
#include "meshing/io/mesh_io.h"
#include "meshing/tube_normals.h"
#include "meshing/tube_warnings.h"
#include "meshing/tubes.h"

namespace curvefusion {

namespace {

struct MeshArguments {
  std::filesystem::path input;
  std::vector<std::filesystem::path> solids;  // to unite with the tubes
  std::filesystem::path output;               // empty = only check the input, a mesh
  double radius_mm = 0;                       // 0 = the radii of the file
  std::string radius_from = "vertex";
  std::string unit;            // empty = the format's own
  std::string purpose;         // "print", or empty
  double min_diameter_mm = 1;  // chosen: what common printers, of .4 mm nozzles, still build
  bool check = false;
  TubeOptions tubes;
  RunOptions run;
};

Vec3 SizeOf(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& vertex : mesh.vertices) box.extend(vertex);
  return box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.sizes().cast<double>());
}

// The unit of the file to write, or of one just written.
MeshUnit UnitOf(const MeshArguments& arguments, const std::filesystem::path& path) {
  if (arguments.purpose == "print") return MeshUnit::kMillimetres;
  if (arguments.unit.empty()) return DefaultUnit(path);
  return arguments.unit == "mm" ? MeshUnit::kMillimetres : MeshUnit::kMetres;
}

// The unit of a mesh from elsewhere, and what is said of it where neither the file nor the user
// tells.
struct AssumedUnit {
  MeshUnit unit;
  const char* remark;
};

AssumedUnit UnitOfInput(const MeshArguments& arguments, const Vec3& size) {
  // Chosen: nothing that is scanned by hand is 20 metres large, nor as small as 20 millimetres.
  constexpr double kLargest = 20;
  const MeshUnit unit = UnitOf(arguments, arguments.input);
  if (!arguments.unit.empty() || OnlyUnit(arguments.input)) return {unit, ""};
  if (unit == MeshUnit::kMetres && size.maxCoeff() <= kLargest) {
    return {unit, " (coordinates taken as metres; --unit mm if they are not)"};
  }
  return {MeshUnit::kMillimetres, " (coordinates taken as millimetres; --unit m if they are not)"};
}

void PrintSize(const Vec3& size, MeshUnit unit, const char* remark) {
  const Vec3 mm = size * (unit == MeshUnit::kMetres ? 1 / kMillimetre : 1);
  fmt::print("  size {:.1f} x {:.1f} x {:.1f} mm{}\n", mm.x(), mm.y(), mm.z(), remark);
}

void PrintReport(const WatertightReport& report, MeshUnit unit) {
  const double cm = (unit == MeshUnit::kMetres ? 1 : kMillimetre) * 100;
  fmt::print("  vertices {}, faces {}, separate pieces {}, genus {}\n", report.vertices,
             report.faces, report.components, report.genus);
  fmt::print("  volume {:.6g} cm3, area {:.6g} cm2, worst angle {:.3g} degrees\n",
             report.volume * cm * cm * cm, report.area * cm * cm, report.min_angle / kDegree);
}

// What is wrong with a mesh, in one sentence.
std::string DefectsOf(const WatertightReport& report) {
  return report.faces > 0 ? report.Defects() : "no faces";
}

// Examines a mesh as another program would find it in its file; the exit code.
int CheckMesh(const TriangleMesh& mesh, MeshUnit unit, bool quiet) {
  const WatertightReport report = ExamineMesh(mesh);
  if (!quiet) {
    PrintReport(report, unit);
    fmt::print("  {}\n", report.IsWatertight() ? "watertight" : DefectsOf(report));
    if (report.defect_place) {
      const Vec3& p = *report.defect_place;
      fmt::print("  the first near ({:g}, {:g}, {:g})\n", p.x(), p.y(), p.z());
    }
  }
  return report.IsWatertight() ? 0 : kDefectFound;
}

int CheckInput(const MeshArguments& arguments) {
  const TriangleMesh mesh = ReadMesh(arguments.input);
  const Vec3 size = SizeOf(mesh);
  const auto [unit, remark] = UnitOfInput(arguments, size);
  if (!arguments.run.quiet) PrintSize(size, unit, remark);
  return CheckMesh(mesh, unit, arguments.run.quiet);
}

void ChooseRadii(const MeshArguments& arguments, SkeletonGraph& skeleton) {
  if (arguments.radius_mm > 0) {
    SetRadius(arguments.radius_mm * kMillimetre, skeleton);
  } else {
    ReduceRadii(arguments.radius_from, skeleton);
  }
}

// Slicers take millimetres, and these two formats.
void CheckPrintFormat(const MeshArguments& arguments) {
  if (arguments.purpose.empty()) return;
  const std::string extension = arguments.output.extension().string();
  if (arguments.unit == "m" || (extension != ".stl" && extension != ".3mf")) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: --for print writes .stl or .3mf, in millimetres",
                            arguments.output.string()));
  }
}

// Refuses wires that a printer leaves out, naming the thinnest.
void RequirePrintable(const MeshArguments& arguments, const SkeletonGraph& skeleton) {
  if (arguments.purpose.empty()) return;
  double thinnest = std::numeric_limits<double>::infinity();
  EdgeId edge = 0;
  for (const EdgeId id : skeleton.Edges()) {
    const std::vector<double>& radii = skeleton.edge(id).radii;
    const double radius = radii.empty() ? arguments.tubes.default_radius
                                        : *std::min_element(radii.begin(), radii.end());
    if (2 * radius >= thinnest) continue;
    thinnest = 2 * radius;
    edge = id;
  }
  if (thinnest >= arguments.min_diameter_mm * kMillimetre) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: curve {} (its number on the report page and for graph --remove) is "
                          "{:.2f} mm thick, less than the {} mm of --min-diameter: give all wires "
                          "one thickness with --radius (half of it, in mm), or lower "
                          "--min-diameter if the printer can print that",
                          arguments.input.string(), edge, thinnest / kMillimetre,
                          arguments.min_diameter_mm));
}

// A mesh to write, and what is to be said of it.
struct MadeMesh {
  TriangleMesh mesh;
  WatertightReport report;
  std::optional<CornerNormals> normals;  // where they are known better than from the triangles
  std::vector<std::string> warnings;
};

MadeMesh MadeOfTubes(const SkeletonGraph& skeleton, const TubeOptions& options) {
  const TubeMesh tubes = BuildTubes(skeleton, options);
  ThrowIfCancelled();
  MadeMesh made{.mesh = ToTriangleMesh(tubes.surface), .report = tubes.report};
  made.normals = ComputeTubeNormals(made.mesh, tubes.paths);
  made.warnings = TubeWarnings(skeleton, tubes, options);
  return made;
}

TriangleMesh ReadSolid(const std::filesystem::path& path) {
  TriangleMesh solid = ReadMesh(path);
  const WatertightReport report = ExamineMesh(solid);
  if (report.IsWatertight()) return solid;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: --solids takes closed meshes, and this one has {}; mesh --check "
                          "tells where",
                          path.string(), DefectsOf(report)));
}

MadeMesh MadeWithSolids(const SkeletonGraph& skeleton,
                        const std::vector<std::filesystem::path>& files,
                        const TubeOptions& options) {
  std::vector<TriangleMesh> solids;
  for (const std::filesystem::path& file : files) solids.push_back(ReadSolid(file));
  const SkeletonGraph led = LedToSolids(skeleton, solids);
  const TubeMesh tubes = BuildTubes(led, options);
  ThrowIfCancelled();
  HybridMesh hybrid = UniteWithSolids(led, tubes, solids, options.default_radius);
  MadeMesh made{.mesh = std::move(hybrid.mesh), .report = hybrid.report};
  made.warnings = TubeWarnings(led, tubes, options);
  for (std::string& warning : HybridWarnings(hybrid)) made.warnings.push_back(std::move(warning));
  return made;
}

int MeshSkeleton(const MeshArguments& arguments) {
  CheckPrintFormat(arguments);
  const MeshUnit unit = UnitOf(arguments, arguments.output);
  CheckMeshFormat(arguments.output, unit);
  RequireApart({arguments.input}, arguments.output);
  RequireApart(arguments.solids, arguments.output);
  SkeletonGraph skeleton = ReadSkeleton(arguments.input);
  MakeFolderOf(arguments.output);
  ChooseRadii(arguments, skeleton);
  RequirePrintable(arguments, skeleton);
  const MadeMesh made = arguments.solids.empty()
                            ? MadeOfTubes(skeleton, arguments.tubes)
                            : MadeWithSolids(skeleton, arguments.solids, arguments.tubes);
  WriteMesh(arguments.output, made.mesh,
            {.unit = unit, .normals = made.normals ? &*made.normals : nullptr});
  if (!arguments.run.quiet) {
    fmt::print("Wrote {} ({})\n", arguments.output.string(),
               unit == MeshUnit::kMetres ? "m" : "mm");
    if (unit == MeshUnit::kMetres && arguments.output.extension() == ".stl") {
      fmt::print("  slicers read .stl in mm: for printing add --for print\n");
    }
    if (!arguments.purpose.empty()) {
      PrintSize(SizeOf(made.mesh), MeshUnit::kMetres, ", at full scale");
      if (arguments.solids.empty() && made.report.components > 1) {
        fmt::print("  {} pieces that do not touch: graph --resolve 3 joins what is within 3 mm\n",
                   made.report.components);
      }
    }
    if (!arguments.check) PrintReport(made.report, MeshUnit::kMetres);
    for (const std::string& warning : made.warnings) fmt::print("  warning: {}\n", warning);
  }
  return arguments.check ? CheckMesh(ReadMesh(arguments.output), unit, arguments.run.quiet) : 0;
}

int RunMesh(const MeshArguments& arguments) {
  LimitThreads(arguments.run);
  if (!arguments.output.empty()) return MeshSkeleton(arguments);
  if (arguments.check) return CheckInput(arguments);
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: name the file to write with -o, or check a mesh with --check",
                          arguments.input.string()));
}

void AddTubeOptions(CLI::App& command, MeshArguments& arguments) {
  CLI::Option* radius =
      command
          .add_option("--radius", arguments.radius_mm,
                      "Radius of all tubes in mm, in place of those of the skeleton")
          ->check(PositiveNumber());
  command
      .add_option("--radius-from", arguments.radius_from,
                  "Which radii of the skeleton: of every vertex (default), the mean of every edge, "
                  "or one global median")
      ->check(CLI::IsMember({"global", "edge", "vertex"}))
      ->excludes(radius);
  command.add_option("--sides", arguments.tubes.sides, "Corners of a tube's cross-section")
      ->check(CLI::Range(8, 64));
}

}  // namespace

void AddMeshCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("mesh",
                         "Make a watertight mesh of tubes around the curves of a skeleton, or "
                         "check a mesh");
  const auto arguments = std::make_shared<MeshArguments>();
  command
      ->add_option(
          "INPUT", arguments->input,
          "A skeleton file (.json, .graphml, .swc, lines in .ply or .obj); with --check and "
          "without -o, the mesh to check")
      ->required();
  command->add_option("-o,--output", arguments->output,
                      "A .ply, .obj, .stl, .glb or .3mf file to write");
  command
      ->add_option(
          "--solids", arguments->solids,
          "A closed mesh in metres to unite with the tubes: solid_parts.ply of reconstruct "
          "--hybrid, or your own; wires that end up to 40 mm before it are led on to it. "
          "May be given several times")
      ->allow_extra_args(false);
  AddTubeOptions(*command, *arguments);
  command
      ->add_option("--unit", arguments->unit,
                   "Unit of the coordinates: m (default; .glb always) or mm (.3mf always)")
      ->check(CLI::IsMember({"m", "mm"}));
  CLI::Option* const purpose =
      command
          ->add_option("--for", arguments->purpose,
                       "print: for a 3D printer, as .stl or .3mf in mm; prints the size, refuses "
                       "wires thinner than --min-diameter")
          ->check(CLI::IsMember({"print"}));
  command
      ->add_option("--min-diameter", arguments->min_diameter_mm,
                   "With --for print: the thinnest wire in mm that the printer builds (1)")
      ->check(PositiveNumber())
      ->needs(purpose);
  command->add_flag("--check", arguments->check,
                    "Examine the mesh as it is read back; exit code 1 at a defect");
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Example:\n  curvefusion mesh result/skeleton.json -o wires.ply\n"
      "  curvefusion mesh result/skeleton.json -o print.stl --unit mm --radius 3 --check\n"
      "  curvefusion mesh result/skeleton.json --for print -o wires.3mf\n"
      "  curvefusion mesh edited.json --solids result/solid_parts.ply --for print -o chair.stl\n"
      "  curvefusion mesh --check anything.obj");
  command->callback([arguments, &exit_code] { exit_code = RunMesh(*arguments); });
}

}  // namespace curvefusion
