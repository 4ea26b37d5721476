#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/commands/command.h"
#include "apps/commands/config_arguments.h"
#include "apps/output_guard.h"
#include "apps/preview.h"
#include "apps/report.h"
#include "apps/report_page.h"
#include "apps/result_folder.h"
#include "apps/run_observer.h"
#include "capture/content/colour_findings.h"
#include "capture/trajectory.h"
#include "experiments/pictures/png.h"
#include "fusion/tracking/tracked_poses.h"
#include "graph/io/graph_io.h"
#include "kernel/atomic_file.h"
#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/free_space.h"
#include "kernel/peak_memory.h"
#include "meshing/io/mesh_io.h"
#include "meshing/tube_warnings.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct ReconstructArguments {
  fs::path sequence;
  fs::path output;
  ConfigArguments config;
  bool force = false;
  bool track = false;
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

void WriteUncertain(const Reconstruction& reconstruction, const fs::path& folder) {
  if (reconstruction.uncertain.graph.empty()) return;
  WriteSkeleton(folder / "uncertain.json", reconstruction.uncertain.graph);
}

// Returns the picture.
ColorImage WriteSkeletonAndPicture(const RunRecord& record, const fs::path& folder) {
  const Reconstruction& reconstruction = record.reconstruction;
  WriteSkeleton(folder / "skeleton.json", reconstruction.skeleton);
  WriteUncertain(reconstruction, folder);
  WriteTumTrajectory(folder / "trajectory.txt", PosesOf(reconstruction.sequence));
  ColorImage preview =
      DrawPreview(reconstruction.skeleton, reconstruction.uncertain.graph, reconstruction.points,
                  reconstruction.sequence, FiguresLine(MeasureGraph(reconstruction.skeleton)));
  WritePng(folder / "preview.png", preview);
  return preview;
}

MeshRecord WriteTubes(const RunRecord& record, const fs::path& folder) {
  const auto start = Clock::now();
  const TubeMesh tubes = BuildTubes(record.reconstruction.skeleton, record.config.tubes);
  WriteMesh(folder / "mesh.ply", ToTriangleMesh(tubes.surface), {});
  return {tubes.report, SecondsSince(start),
          TubeWarnings(record.reconstruction.skeleton, tubes, record.config.tubes)};
}

// The page tells what else will be there, by the names that it will have.
std::vector<std::string> FilesBesideThePage(const ResultFolder& output, const fs::path& folder) {
  const bool found = fs::exists(folder / "skeleton.json");
  const std::string nothing_report = output.NothingFoundName("report.json");
  if (!found && nothing_report != "report.json") {
    return {nothing_report, output.NothingFoundName("config.toml")};
  }
  std::vector<std::string> files;
  for (const std::string& name : ResultNames()) {
    if (fs::exists(folder / name) || name == "report.json") files.push_back(name);
  }
  return files;
}

// The report and its page tell of all that came before them.
void WriteReport(RunRecord& record, const ColorImage& preview, Clock::time_point start,
                 const ResultFolder& output, const fs::path& folder) {
  WriteText(folder / "config.toml", ConfigToml(record.config));
  const PagePictures pictures = MakePagePictures(record.reconstruction, preview);
  record.seconds = SecondsSince(start);
  record.peak_memory = PeakMemory();
  WriteText(folder / "report.html",
            ReportPage(record, pictures, FilesBesideThePage(output, folder)));
  WriteText(folder / "report.json", ReportJson(record));
}

// Where the curves have no sound mesh the other files are complete without it; the error follows.
void WriteResult(RunRecord& record, Clock::time_point start, const ResultFolder& output) {
  std::optional<Error> failure;
  output.Replace([&](const fs::path& folder) {
    const ColorImage preview = WriteSkeletonAndPicture(record, folder);
    try {
      record.mesh = WriteTubes(record, folder);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kBadInput) throw;
      failure = WithPathReplaced(error, folder, output.path());
    }
    WriteReport(record, preview, start, output, folder);
  });
  if (!failure) return;
  throw Error(failure->kind(), fmt::format("{}; {} is complete", failure->what(),
                                           (output.path() / "skeleton.json").string()));
}

void RequireInputStays(const ReconstructArguments& arguments) {
  const fs::path& volume = arguments.stages.volume;
  for (const fs::path& output : {arguments.output, arguments.stages.folder, volume}) {
    RequireOutside(arguments.sequence, output);
  }
  RequireApart({arguments.config.file}, arguments.output / "config.toml");
  RequireApart({arguments.config.file}, volume);
}

void RequireRoom(const ReconstructArguments& arguments, const Sequence& sequence) {
  // Chosen: five times what a wire cube takes, whose result has 3 MB, volume 1 MB.
  constexpr std::uintmax_t kFiles = 16u << 20;
  // Measured (25 frames of that cube, --save-stages): 57 kB a frame; the double for larger objects.
  constexpr std::uintmax_t kStagesOfFrame = 114000;
  RequireFreeSpace(arguments.output, kFiles);
  const auto frames = static_cast<std::uintmax_t>(sequence.frame_count());
  const StageOutputs& stages = arguments.stages;
  if (!stages.folder.empty()) RequireFreeSpace(stages.folder, kStagesOfFrame * frames);
  if (!stages.volume.empty()) RequireFreeSpace(stages.volume, kFiles);
}

int RunReconstruct(const ReconstructArguments& arguments) {
  const auto start = Clock::now();
  const Config config = ReadConfig(Sources(arguments.config));
  LimitThreads(arguments.run);
  Sequence sequence =
      OpenSequence(arguments.sequence, arguments.track ? PoseUse::kIgnored : PoseUse::kIfGiven);
  RequireInputStays(arguments);
  RequireRoom(arguments, sequence);
  const ResultFolder output(arguments.output, {arguments.stages.folder, arguments.stages.volume},
                            arguments.force);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const bool fitted = arguments.colour_camera == "auto" && UseFittedColourCamera(sequence);
  const std::optional<TrackingResult> tracking =
      FindPoses(sequence, InterruptibleProgress(printer));
  RunObserver observer(printer, arguments.stages);
  const Reconstruction reconstruction = Reconstruct(sequence, config.pipeline, observer);
  printer.Report(kWritingStage, 0, 1);
  ThrowIfCancelled();

  RunRecord record{sequence, config, reconstruction, {}, 0, 0, fitted, tracking};
  const bool found = !reconstruction.skeleton.empty();
  const auto final_path = [&](const char* name) {
    return output.path() / (found ? name : output.NothingFoundName(name));
  };
  const fs::path page = final_path("report.html");
  const fs::path report = final_path("report.json");
  if (found) {
    WriteResult(record, start, output);
  } else {
    output.AddNothingFound([&](const fs::path& folder) {
      WriteUncertain(reconstruction, folder);
      WriteReport(record, {}, start, output, folder);
    });
  }
  printer.Finish();
  if (!arguments.run.quiet) fmt::print("{}", Summary(record, output.path(), page, report));
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
                   "Folder for skeleton.json, trajectory.txt, mesh.ply, preview.png, report.html, "
                   "report.json, config.toml")
      ->required();
  command->add_flag("--force", arguments->force,
                    "Take an output folder that holds other things; they stay as they are");
  AddConfigArguments(*command, arguments->config);
  command->add_flag("--track", arguments->track,
                    "Find the camera poses by tracking (see track) even where the sequence has "
                    "some; without poses this is done anyway");
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
                      "Mesh file for the surface of large objects: .ply, .obj, .stl, .glb or .3mf");
  command->footer(
      "Example:\n  curvefusion reconstruct scan -o result\n"
      "  curvefusion reconstruct scan -o result --profile paper --set volume.voxel_size=0.01\n"
      "  curvefusion reconstruct scan -o result --track\n"
      "  curvefusion reconstruct scan -o result --save-stages result/stages");
  command->callback([arguments, &exit_code] { exit_code = RunReconstruct(*arguments); });
}

}  // namespace curvefusion
