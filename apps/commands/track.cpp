#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands/command.h"
#include "apps/output_guard.h"
#include "capture/content/colour_findings.h"
#include "capture/trajectory.h"
#include "experiments/metrics/trajectory_metrics.h"
#include "fusion/tracking/track_sequence.h"
#include "fusion/tracking/tracked_poses.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kRadiansPerDegree = 0.017453292519943295;
constexpr double kReferenceGap = 0.1;  // seconds between poses of a reference to interpolate over

struct TrackArguments {
  fs::path sequence;
  fs::path output;
  fs::path reference;
  bool depth_only = false;
  RunOptions run;
};

// Poses of the tracked frames, and those of the reference at the same times.
struct PosePairs {
  std::vector<RigidTransform> tracked;
  std::vector<RigidTransform> reference;
};

PosePairs PairPoses(const Sequence& tracked, const fs::path& file) {
  const Trajectory reference = ReadTumTrajectory(file, [](const CheckFinding& finding) {
    if (finding.severity == Severity::kError) {
      throw Error(ErrorKind::kBadInput, finding.message);
    }
  });
  PosePairs pairs;
  for (const SequenceFrame& frame : tracked.frames) {
    const auto pose = PoseAt(reference, frame.timestamp, kReferenceGap);
    if (!pose) continue;
    pairs.tracked.push_back(frame.T_world_camera);
    pairs.reference.push_back(*pose);
  }
  if (pairs.tracked.size() < 3) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has poses for {} of the {} tracked frames, 3 are needed; do its "
                            "stamps use the clock of the images?",
                            file.string(), pairs.tracked.size(), tracked.frames.size()));
  }
  return pairs;
}

void PrintErrors(const PosePairs& pairs) {
  const auto count = static_cast<int>(pairs.tracked.size());
  fmt::print("ATE          {:.1f} mm rmse over {} poses\n",
             AbsoluteTrajectoryError(pairs.tracked, pairs.reference) / kMillimetre, count);
  for (const int gap : {1, 30}) {
    if (count <= gap) continue;
    const RelativePoseError error = RelativePoseErrors(pairs.tracked, pairs.reference, gap);
    fmt::print("RPE          {:.1f} mm, {:.2f} degrees rmse over {} frame{}\n",
               error.translation / kMillimetre, error.rotation / kRadiansPerDegree, gap,
               gap == 1 ? "" : "s");
  }
}

void PrintResult(const TrackingResult& result, const Sequence& images, double seconds) {
  fmt::print("tracked      {} of {} frames, {} keyframes, {:.1f} frames a second\n",
             result.sequence.frame_count(), images.frame_count(), result.keyframes,
             images.frame_count() / seconds);
  for (const LostFrame& frame : result.lost)
    fmt::print("lost         {}: {}\n", frame.name, frame.why);
  for (const std::string& warning : result.warnings) fmt::print("warning: {}\n", warning);
  const std::string doubt = DoubtOfPoses(result.sequence);
  if (!doubt.empty()) fmt::print("warning: {}\n", doubt);
}

int RunTrack(const TrackArguments& arguments) {
  LimitThreads(arguments.run);
  RequireOutside(arguments.sequence, arguments.output);
  RequireApart({arguments.reference}, arguments.output);
  Sequence images = OpenSequence(arguments.sequence, PoseUse::kIgnored);
  TrackingOptions options;
  options.use_color = !arguments.depth_only;
  if (options.use_color) UseFittedColourCamera(images);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const auto start = Clock::now();
  const TrackingResult result =
      TrackSequence(images, GivenStart(images), options, InterruptibleProgress(printer));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  WriteTumTrajectory(arguments.output, PosesOf(result.sequence));
  printer.Finish();
  if (!arguments.run.quiet) PrintResult(result, images, seconds);
  if (!arguments.reference.empty()) PrintErrors(PairPoses(result.sequence, arguments.reference));
  return 0;
}

}  // namespace

void AddTrackCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("track", "Find the camera poses of a sequence from depth and colour");
  const auto arguments = std::make_shared<TrackArguments>();
  command
      ->add_option("SEQUENCE", arguments->sequence,
                   "The scan: a folder of images, or a recording such as scan.bag")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "File for the poses: lines 't tx ty tz qx qy qz qw' (TUM), camera in world")
      ->required();
  command->add_option("--reference", arguments->reference,
                      "A trajectory (TUM) to compare with: prints ATE and RPE");
  command->add_flag("--depth-only", arguments->depth_only,
                    "Leave out colour: KinectFusion's tracker");
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Poses that the sequence has are not used, but for the first, at which the path starts;\n"
      "without one it starts at the origin. Frames that cannot be placed are named and left out.\n"
      "Example:\n  curvefusion track scan -o trajectory.txt\n"
      "  curvefusion track scan -o trajectory.txt --reference scan/groundtruth.txt");
  command->callback([arguments, &exit_code] { exit_code = RunTrack(*arguments); });
}

}  // namespace curvefusion
