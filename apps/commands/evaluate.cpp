#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "apps/commands/command.h"
#include "apps/evaluation_table.h"
#include "apps/output_folder.h"
#include "apps/output_guard.h"
#include "apps/result_folder.h"
#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/truth.h"
#include "graph/io/graph_io.h"
#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "meshing/io/mesh_io.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

struct EvaluateArguments {
  fs::path result;
  fs::path truth;
  fs::path mesh;
  fs::path json;
  fs::path csv;
  RunOptions run;
};

Evaluation EvaluateFiles(const EvaluateArguments& arguments) {
  const SkeletonGraph truth = ReadTruth(arguments.truth);
  std::optional<TriangleMesh> mesh;
  if (!arguments.mesh.empty()) mesh = ReadMesh(arguments.mesh);
  if (arguments.result.empty()) return EvaluateMesh(*mesh, truth);
  const bool is_folder = fs::is_directory(arguments.result);
  const SkeletonGraph result =
      ReadSkeleton(is_folder ? arguments.result / "skeleton.json" : arguments.result);
  return Evaluate(result, mesh ? &*mesh : nullptr, truth);
}

// A file itself, or all files of a folder.
std::vector<fs::path> FilesOf(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_directory(path, failure)) return {path};
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(path, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    files.push_back(entry->path());
  }
  return files;
}

// Scores may lie in the folder of a result: only what a reconstruction has written there is input.
std::vector<fs::path> InputFiles(const EvaluateArguments& arguments) {
  std::vector<fs::path> files = FilesOf(arguments.truth);
  files.push_back(arguments.mesh);
  files.push_back(arguments.result);
  for (const std::string& name : ResultNames()) files.push_back(arguments.result / name);
  return files;
}

int RunEvaluate(const EvaluateArguments& arguments) {
  if (arguments.result.empty() && arguments.mesh.empty()) {
    throw Error(ErrorKind::kUsage, "name a result folder, a skeleton.json or a --mesh to evaluate");
  }
  LimitThreads(arguments.run);
  const std::vector<fs::path> inputs = InputFiles(arguments);
  RequireApart(inputs, arguments.json);
  RequireApart(inputs, arguments.csv);
  RequireApart({arguments.json}, arguments.csv);
  MakeFolderOf(arguments.json);
  MakeFolderOf(arguments.csv);
  const Evaluation evaluation = EvaluateFiles(arguments);
  ThrowIfCancelled();
  const fs::path& evaluated = arguments.result.empty() ? arguments.mesh : arguments.result;
  const EvaluationLabels labels{evaluated.string(), arguments.truth.string()};
  if (!arguments.json.empty()) WriteEvaluation(arguments.json, labels, evaluation);
  if (!arguments.csv.empty()) AppendEvaluation(arguments.csv, labels, evaluation);
  if (!arguments.run.quiet) fmt::print("{}", EvaluationTable(evaluation));
  return 0;
}

}  // namespace

void AddEvaluateCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("evaluate", "Compare a result with a known truth");
  const auto arguments = std::make_shared<EvaluateArguments>();
  command->add_option("OUT", arguments->result,
                      "A result folder or a skeleton.json; may be left out beside --mesh");
  command
      ->add_option("--truth", arguments->truth,
                   "The truth/ folder of a simulated scan, a skeleton.json with radii, or a "
                   "curves.json")
      ->required();
  command->add_option(
      "--mesh", arguments->mesh,
      "A mesh in metres (PLY, OBJ, STL) to compare with the true tubes' surface and volume");
  command->add_option("--json", arguments->json, "Write all figures as JSON");
  command->add_option("--csv", arguments->csv,
                      "Add all figures as a row to a CSV file, which is made where it is missing");
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Raw figures compare the result as it lies; aligned ones after the rigid motion, of some\n"
      "centimetres and degrees, under which most of the truth is explained; those of the main "
      "piece,\n"
      "the connected piece that explains most of it, after the same motion. P and R are the shares "
      "of the result that is true and of the\n"
      "truth that was found, F is their harmonic mean; - means there is nothing to take them of.\n"
      "Of a mesh, what lies within 30 mm of the true object's bounding box is compared by area "
      "with\n"
      "the surface of the true tubes, not with their centre lines. Without OUT it is aligned "
      "itself.\n"
      "Example:\n  curvefusion evaluate result --truth scan/truth\n"
      "  curvefusion evaluate result --truth scan/truth --mesh result/mesh.ply --csv all.csv\n"
      "  curvefusion evaluate --truth scan/truth --mesh volume.ply");
  command->callback([arguments, &exit_code] { exit_code = RunEvaluate(*arguments); });
}

}  // namespace curvefusion
