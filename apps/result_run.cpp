#include "apps/result_run.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/command.h"
#include "apps/hybrid_result.h"
#include "apps/preview.h"
#include "apps/report.h"
#include "apps/report_page.h"
#include "capture/content/colour_findings.h"
#include "capture/trajectory.h"
#include "experiments/pictures/png.h"
#include "experiments/shard_run.h"
#include "fusion/tracking/tracked_poses.h"
#include "graph/io/graph_io.h"
#include "kernel/atomic_file.h"
#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/peak_memory.h"
#include "meshing/io/mesh_io.h"
#include "meshing/tube_warnings.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void WriteUncertain(const Reconstruction& reconstruction, const fs::path& folder) {
  if (reconstruction.uncertain.graph.empty()) return;
  WriteSkeleton(folder / "uncertain.json", reconstruction.uncertain.graph);
}

ColorImage WritePicture(const Reconstruction& reconstruction, const std::string& title,
                        const fs::path& folder) {
  ColorImage preview = DrawPreview(reconstruction.skeleton, reconstruction.uncertain.graph,
                                   reconstruction.points, reconstruction.sequence, title);
  WritePng(folder / "preview.png", preview);
  return preview;
}

// Returns the picture.
ColorImage WriteSkeletonAndPicture(const RunRecord& record, const fs::path& folder) {
  const Reconstruction& reconstruction = record.reconstruction;
  WriteSkeleton(folder / "skeleton.json", reconstruction.skeleton);
  WriteUncertain(reconstruction, folder);
  WriteTumTrajectory(folder / "trajectory.txt", PosesOf(reconstruction.sequence));
  return WritePicture(reconstruction, FiguresLine(MeasureGraph(reconstruction.skeleton)), folder);
}

// Likewise where nothing is certain; nothing where nothing is uncertain either.
ColorImage WriteUncertainAndPicture(const Reconstruction& reconstruction, const fs::path& folder) {
  if (reconstruction.uncertain.graph.empty()) return {};
  WriteUncertain(reconstruction, folder);
  return WritePicture(reconstruction, "nothing thin that is proven", folder);
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
  WriteBytesAtomically(folder / "config.toml", ConfigToml(record.config));
  const PagePictures pictures = MakePagePictures(record.reconstruction, preview);
  record.seconds = SecondsSince(start);
  record.peak_memory = PeakMemory();
  WriteBytesAtomically(folder / "report.html",
                       ReportPage(record, pictures, FilesBesideThePage(output, folder)));
  WriteBytesAtomically(folder / "report.json", ReportJson(record));
}

// Where the curves have no sound mesh the other files are complete without it; the error follows.
void WriteResult(RunRecord& record, const ResultRun& run, const ResultFolder& output,
                 const Progress& progress) {
  std::optional<Error> failure;
  output.Replace([&](const fs::path& folder) {
    const ColorImage preview = WriteSkeletonAndPicture(record, folder);
    try {
      record.mesh = WriteTubes(record, folder);
      if (run.hybrid) {
        record.hybrid = WriteHybrid(record.reconstruction, record.config.tubes, folder, progress);
      }
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kBadInput) throw;
      failure = WithPathReplaced(error, folder, output.path());
    }
    WriteReport(record, preview, run.start, output, folder);
  });
  if (!failure) return;
  throw Error(failure->kind(), fmt::format("{}; {} is complete", failure->what(),
                                           (output.path() / "skeleton.json").string()));
}

Reconstruction ReconstructAs(const ResultRun& run, const Sequence& sequence,
                             RunObserver& observer) {
  if (run.shards.empty()) return Reconstruct(sequence, run.config.pipeline, observer);
  return ReconstructFromShards(run.shards, sequence, run.config, observer,
                               !run.stages.volume.empty());
}

}  // namespace

int ReconstructInto(const ResultFolder& output, Sequence sequence, const ResultRun& run,
                    ProgressPrinter& printer) {
  sequence = KeepingImages(std::move(sequence));
  const bool fitted = run.fit_colour_camera && UseFittedColourCamera(sequence);
  const std::optional<TrackingResult> tracking =
      FindPoses(sequence, InterruptibleProgress(printer));
  RunObserver observer(printer, run.stages);
  const Reconstruction reconstruction = ReconstructAs(run, sequence, observer);
  printer.Report(kWritingStage, 0, 1);
  ThrowIfCancelled();

  RunRecord record{sequence, run.config, reconstruction, {}, 0, 0, fitted, tracking};
  const bool found = !reconstruction.skeleton.empty();
  const auto final_path = [&](const char* name) {
    return output.path() / (found ? name : output.NothingFoundName(name));
  };
  const fs::path page = final_path("report.html");
  const fs::path report = final_path("report.json");
  if (found) {
    WriteResult(record, run, output, InterruptibleProgress(printer));
  } else {
    output.AddNothingFound([&](const fs::path& folder) {
      const ColorImage preview = WriteUncertainAndPicture(reconstruction, folder);
      WriteReport(record, preview, run.start, output, folder);
    });
  }
  printer.Finish();
  if (!run.quiet) fmt::print("{}", Summary(record, output.path(), page, report));
  return found ? 0 : kNothingThin;
}

}  // namespace curvefusion
