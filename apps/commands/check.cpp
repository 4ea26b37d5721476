#include "capture/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/commands/command.h"
#include "apps/output_guard.h"
#include "capture/check_json.h"
#include "capture/content/repair.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

struct CheckArguments {
  std::filesystem::path sequence;
  std::filesystem::path repaired;
  bool json = false;
  RunOptions run;
};

void PrintFigures(const CheckReport& report) {
  const ImageSizes& sizes = report.image_sizes;
  fmt::print("format       {}\n", report.format.empty() ? "unknown" : report.format);
  if (report.frames == 0) return;
  fmt::print("frames       {} ({} without pose, {} without partner)\n", report.frames,
             report.frames_without_pose, report.frames_without_partner);
  if (report.has_depth) {
    fmt::print("depth        {} x {}, {:g} units per metre, {:.0f} % valid, median {:.2f} m\n",
               sizes.depth_width, sizes.depth_height, report.depth_scale,
               100 * report.depth_validity, report.median_depth);
  } else {
    fmt::print("depth        none\n");
  }
  fmt::print("colour       {} x {}\n", sizes.color_width, sizes.color_height);
  if (report.colour_camera.measured) {
    fmt::print(
        "registration depth edges lie {:.1f} px from colour edges in the mean, {:.1f} px at best\n",
        report.colour_camera.given_px, report.colour_camera.fitted_px);
  }
  const std::string duration =
      report.duration > 0 ? fmt::format(" in {:.1f} s", report.duration) : "";
  fmt::print("camera path  {}{}\n",
             report.has_poses ? fmt::format("{:.2f} m", report.trajectory_length) : "unknown",
             duration);
}

// How far depth of different views disagrees, by gap and by distance.
void PrintGeometry(const GeometryReport& geometry) {
  if (!geometry.is_judged) {
    if (!geometry.why_not.empty()) {
      fmt::print("poses        cannot be judged by depth: {}\n", geometry.why_not);
    }
    return;
  }
  for (const DepthDisagreement& part : geometry.by_gap) {
    fmt::print(
        "poses        depth {} frame{} apart differs by {:.1f} mm (spread {:.1f} mm, sensor "
        "noise {:.1f} mm), overlap {:.0f} %\n",
        part.gap, part.gap == 1 ? "" : "s", part.residual / kMillimetre, part.spread / kMillimetre,
        part.noise / kMillimetre, 100 * part.overlap);
  }
  for (const DepthDisagreement& part : geometry.by_distance) {
    fmt::print("             at {:.2f} m by {:.1f} mm (spread {:.1f} mm, sensor noise {:.1f} mm)\n",
               part.distance, part.residual / kMillimetre, part.spread / kMillimetre,
               part.noise / kMillimetre);
  }
}

void PrintFindings(const CheckReport& report) {
  for (const CheckFinding& finding : report.findings) {
    const char* severity = finding.severity == Severity::kError ? "error" : "warning";
    const std::string cause = finding.cause.empty() ? "" : " [" + finding.cause + "]";
    fmt::print("{}{}: {}\n", severity, cause, finding.message);
  }
  if (report.findings.empty()) {
    fmt::print("nothing is wrong with this sequence\n");
  } else if (!report.has_errors()) {
    fmt::print("no errors: this can be reconstructed, but the warnings tell what will suffer\n");
  }
}

const char* AboutImages(const SequenceCorrection& correction) {
  if (correction.sequence.IsRecording()) return "; its images are copies";
  return correction.swap_bytes ? "; its depth images are written anew, colour is linked"
                               : "; its images are links";
}

// Writes the corrected copy and checks it; the exit code is that of the copy.
int Repair(const CheckArguments& arguments, const CheckReport& report) {
  const bool prints = !arguments.run.quiet && !arguments.json;
  if (!report.geometry.correction) {
    if (prints) fmt::print("nothing that --repair can correct: no copy is written\n");
    return report.has_errors() ? ExitCode(ErrorKind::kBadInput) : 0;
  }
  const SequenceCorrection& correction = *report.geometry.correction;
  WriteRepairedSequence(correction, arguments.repaired);
  const CheckReport repaired = CheckSequence(arguments.repaired, NoProgress);
  if (prints) {
    fmt::print("\nWrote {} with {} frames ({}){}\n", arguments.repaired.string(),
               correction.sequence.frames.size(), fmt::join(correction.made, "; "),
               AboutImages(correction));
    PrintGeometry(repaired.geometry);
    PrintFindings(repaired);
  }
  return repaired.has_errors() ? ExitCode(ErrorKind::kBadInput) : 0;
}

int RunCheck(const CheckArguments& arguments) {
  LimitThreads(arguments.run);
  RequireOutside(arguments.sequence, arguments.repaired);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const CheckReport report = CheckSequence(arguments.sequence, InterruptibleProgress(printer));
  printer.Finish();
  if (arguments.json) {
    fmt::print("{}", CheckJson(report));
  } else if (!arguments.run.quiet) {
    PrintFigures(report);
    PrintGeometry(report.geometry);
    PrintFindings(report);
  }
  if (!arguments.repaired.empty()) return Repair(arguments, report);
  return report.has_errors() ? ExitCode(ErrorKind::kBadInput) : 0;
}

}  // namespace

void AddCheckCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "check", "Check a sequence before it is reconstructed; exit code 3 at errors");
  const auto arguments = std::make_shared<CheckArguments>();
  command
      ->add_option("SEQUENCE", arguments->sequence,
                   "The scan: a folder of images, or a recording such as scan.bag")
      ->required();
  command->add_option("--repair", arguments->repaired,
                      "Folder for a corrected copy where poses, depth unit, clocks or order are "
                      "wrong; its images are links");
  command->add_flag("--json", arguments->json,
                    "Print all figures and findings as one JSON object instead, also with --quiet");
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Example:\n  curvefusion check scan\n  curvefusion check scan --repair scan_repaired\n"
      "  curvefusion check scan --json --quiet");
  command->callback([arguments, &exit_code] { exit_code = RunCheck(*arguments); });
}

}  // namespace curvefusion
