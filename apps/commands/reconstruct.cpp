#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/commands/command.h"
#include "apps/commands/config_arguments.h"
#include "apps/output_folder.h"
#include "apps/preview.h"
#include "apps/report.h"
#include "apps/run_observer.h"
#include "apps/tube_warnings.h"
#include "capture/content/colour_findings.h"
#include "capture/content/geometry_check.h"
#include "capture/trajectory.h"
#include "experiments/pictures/png.h"
#include "graph/graph_io.h"
#include "kernel/atomic_file.h"
#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/peak_memory.h"
#include "meshing/mesh_io.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct ReconstructArguments {
  fs::path sequence;
  fs::path output;
  ConfigArguments config;
  StageOutputs stages;
  std::string colour_camera = "auto";
  RunOptions run;
};

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void WriteText(const fs::path& path, const std::string& text) {
  WriteStreamAtomically(path, [&](std::ostream& stream) { stream << text; });
}

// An earlier result must not be taken for this run's, which has none.
void RemoveEarlierResult(const fs::path& folder) {
  for (const char* name :
       {"skeleton.json", "trajectory.txt", "mesh.ply", "preview.png", "report.json"})
    fs::remove(folder / name);
}

Trajectory CorrectedTrajectory(const Sequence& sequence) {
  Trajectory trajectory;
  for (const SequenceFrame& frame : sequence.frames)
    trajectory.push_back({frame.timestamp, frame.T_world_camera});
  return trajectory;
}

void WriteSkeletonAndPicture(const RunRecord& record, const fs::path& folder) {
  const Reconstruction& reconstruction = record.reconstruction;
  WriteSkeleton(folder / "skeleton.json", reconstruction.skeleton);
  WriteTumTrajectory(folder / "trajectory.txt", CorrectedTrajectory(reconstruction.sequence));
  WritePng(folder / "preview.png",
           DrawPreview(reconstruction.skeleton, reconstruction.points, reconstruction.sequence,
                       FiguresLine(MeasureGraph(reconstruction.skeleton))));
}

// Sweeps and writes the tubes. Where that fails the skeleton stays.
MeshRecord WriteTubes(const RunRecord& record, const fs::path& folder) {
  const auto start = Clock::now();
  try {
    const TubeMesh tubes = BuildTubes(record.reconstruction.skeleton, record.config.tubes);
    WriteMesh(folder / "mesh.ply", ToTriangleMesh(tubes.surface), {});
    return {tubes.report, SecondsSince(start),
            TubeWarnings(record.reconstruction.skeleton, tubes, record.config.tubes)};
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}; {} is complete", error.what(),
                                          (folder / "skeleton.json").string()));
  }
}

void WriteReport(RunRecord& record, Clock::time_point start, const fs::path& folder) {
  record.seconds = SecondsSince(start);
  record.peak_memory = PeakMemory();
  WriteText(folder / "report.json", ReportJson(record));
}

int RunReconstruct(const ReconstructArguments& arguments) {
  const auto start = Clock::now();
  const Config config = ReadConfig(Sources(arguments.config));
  LimitThreads(arguments.run);
  Sequence sequence = OpenSequence(arguments.sequence);
  RequireFittingPoses(sequence);
  MakeOutputFolder(arguments.output);
  const bool fitted = arguments.colour_camera == "auto" && UseFittedColourCamera(sequence);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  RunObserver observer(printer, arguments.stages);
  const Reconstruction reconstruction = Reconstruct(sequence, config.pipeline, observer);
  printer.Finish();
  ThrowIfCancelled();

  RunRecord record{sequence, config, reconstruction, {}, 0, 0, fitted};
  RemoveEarlierResult(arguments.output);
  WriteText(arguments.output / "config.toml", ConfigToml(config));
  const bool found = !reconstruction.skeleton.empty();
  if (found) {
    WriteSkeletonAndPicture(record, arguments.output);
    try {
      record.mesh = WriteTubes(record, arguments.output);
    } catch (const Error&) {
      WriteReport(record, start, arguments.output);
      throw;
    }
  }
  WriteReport(record, start, arguments.output);
  if (!arguments.run.quiet) fmt::print("{}", Summary(record, arguments.output));
  return found ? 0 : kNothingThin;
}

}  // namespace

void AddReconstructCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "reconstruct", "Turn an RGB-D sequence into a curve skeleton and a tube mesh");
  const auto arguments = std::make_shared<ReconstructArguments>();
  command->add_option("SEQUENCE", arguments->sequence, "Folder of the sequence")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for skeleton.json, trajectory.txt, mesh.ply, preview.png, report.json, "
                   "config.toml")
      ->required();
  AddConfigArguments(*command, arguments->config);
  command
      ->add_option("--colour-camera", arguments->colour_camera,
                   "auto: where colour edges lie far from depth edges, the colour camera that was "
                   "fitted to them is used; given: always that of the intrinsics")
      ->check(CLI::IsMember({"auto", "given"}))
      ->capture_default_str();
  AddRunOptions(*command, arguments->run);
  command->add_option("--save-stages", arguments->stages.folder,
                      "Folder for the points and curves of every step, as PLY");
  command->add_option("--save-volume", arguments->stages.volume,
                      "PLY file for the surface of large objects");
  command->footer(
      "Example:\n  curvefusion reconstruct scan -o result\n"
      "  curvefusion reconstruct scan -o result --profile paper --set volume.voxel_size=0.01\n"
      "  curvefusion reconstruct scan -o result --save-stages result/stages");
  command->callback([arguments, &exit_code] { exit_code = RunReconstruct(*arguments); });
}

}  // namespace curvefusion
