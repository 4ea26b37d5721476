#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "apps/commands/command.h"
#include "apps/output_folder.h"
#include "apps/output_guard.h"
#include "experiments/reproduction/reproduction.h"
#include "experiments/reproduction/reproduction_page.h"
#include "experiments/simulation/depth_sensor.h"
#include "experiments/studies/regression_check.h"
#include "experiments/studies/studies.h"
#include "experiments/studies/study_runner.h"
#include "experiments/sweeps/cell_measurement.h"
#include "kernel/error.h"
#include "kernel/run_lock.h"

namespace curvefusion {

namespace {

constexpr int kRunsFailed = 1;
constexpr int kFellBehindBaseline = 1;

struct ExperimentArguments {
  std::vector<std::string> names;
  std::filesystem::path output;
  std::filesystem::path baseline;
  double tolerance = 0.02;
  std::string profile = "both";
  std::string split = "train";
  StudyRequest request;
  RunnerOptions runner;
  RunOptions run;
};

StudyRequest RequestOf(const ExperimentArguments& arguments) {
  StudyRequest request = arguments.request;
  if (arguments.profile != "both") request.profiles = {ProfileNamed(arguments.profile)};
  request.split = SplitNamed(arguments.split);
  return request;
}

void PrintPlan(const StudyPlan& plan, bool remeasure) {
  fmt::print("{} runs, {} of them finished earlier\n", plan.cases.size(), plan.finished);
  if (plan.other_settings > 0) {
    fmt::print("  {} measured earlier with other settings will be replaced\n", plan.other_settings);
  }
  if (plan.other_revision > 0) {
    fmt::print("  {} of the finished were measured by another revision of this program; {}\n",
               plan.other_revision,
               remeasure ? "they are measured again" : "--remeasure measures them again");
  }
}

int PrintOutcome(const StudyResults& results, bool quiet) {
  int failed = 0;
  for (const StudyRun& run : results.runs) {
    if (run.outcome != "failed") continue;
    ++failed;
    fmt::print(stderr, "failed: {}: {}\n", run.folder.string(), run.message);
  }
  if (!quiet) {
    fmt::print("Wrote {} (.csv, .tex, .md, .png, .pdf)\n",
               (results.folder / results.stem).string() + "*");
  }
  return failed > 0 ? kRunsFailed : 0;
}

int PrintComparison(const std::vector<StudyRun>& before, const StudyResults& results,
                    double tolerance) {
  const RegressionCheck check = CompareWithBaseline(before, results.runs, tolerance);
  fmt::print("{}{}\n", MarkdownTable(check.table),
             check.fell ? fmt::format("Worse than the baseline by more than {}", tolerance)
                        : fmt::format("No worse than the baseline by more than {}", tolerance));
  return check.fell ? kFellBehindBaseline : 0;
}

// Cells of sweeps are taken and left where the user has named folders of these.
RunnerOptions WithCells(RunnerOptions runner, const std::filesystem::path& folder) {
  if (runner.caches.empty()) return runner;
  runner.reconstruct = MeasurementByCells({folder, runner.caches});
  return runner;
}

// What an interrupted study leaves is worth more than other commands' nothing.
StudyResults RunOrTellHowToGoOn(const Study& study, const StudyRequest& request,
                                const ExperimentArguments& arguments, const Progress& progress) {
  try {
    return RunStudy(study, request, arguments.output, WithCells(arguments.runner, arguments.output),
                    progress);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    throw Error(ErrorKind::kInterrupted,
                "interrupted; finished runs are kept, and the same command goes on from there");
  }
}

// A study that may be run: what could be refused has been looked at.
struct PlannedStudy {
  Study study;
  StudyPlan plan;
  std::vector<StudyRun> baseline;
};

PlannedStudy Planned(const Study& study, const StudyRequest& request,
                     const ExperimentArguments& arguments) {
  PlannedStudy planned{study, PlanStudy(study, request, arguments.output), {}};
  if (!arguments.baseline.empty()) {
    planned.baseline = ReadBaseline(study, request, arguments.baseline);
  }
  return planned;
}

int RunOne(const PlannedStudy& planned, const StudyRequest& request,
           const ExperimentArguments& arguments, ProgressPrinter& printer) {
  if (!arguments.run.quiet) {
    fmt::print("{}: ", planned.study.name);
    PrintPlan(planned.plan, arguments.runner.remeasure);
    std::fflush(stdout);  // before the progress, which goes to the other stream
  }
  const StudyResults results =
      RunOrTellHowToGoOn(planned.study, request, arguments, InterruptibleProgress(printer));
  printer.Finish();
  const int outcome = PrintOutcome(results, arguments.run.quiet);
  if (planned.baseline.empty()) return outcome;
  return std::max(outcome, PrintComparison(planned.baseline, results, arguments.tolerance));
}

constexpr const char* kAll = "all";                    // those that test a claim, then the page
constexpr const char* kReproduction = "reproduction";  // the page alone

std::vector<Study> StudiesOf(const std::vector<std::string>& names) {
  std::vector<Study> studies;
  for (const std::string& name : names) {
    if (name == kReproduction) continue;
    if (name != kAll) {
      studies.push_back(StudyNamed(name));
      continue;
    }
    const std::vector<Study> of_claims = StudiesOfClaims();
    studies.insert(studies.end(), of_claims.begin(), of_claims.end());
  }
  return studies;
}

bool WantsPage(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [](const std::string& name) { return name == kAll || name == kReproduction; });
}

// Chosen: about what a frame of table1 takes on two cores, simulated and reconstructed.
constexpr double kSecondsPerFrame = 0.2;

// Seconds for what is not finished.
double WorkLeft(const StudyPlan& plan, bool remeasure) {
  double frames = 0;
  for (const StudyCase& study_case : plan.cases) frames += FramesOf(study_case);
  const double kept = plan.finished - (remeasure ? plan.other_revision : 0);
  return kSecondsPerFrame * frames *
         (1 - kept / std::max(1.0, static_cast<double>(plan.cases.size())));
}

std::vector<PlannedStage> StagesOf(const std::vector<PlannedStudy>& studies, bool remeasure) {
  std::vector<PlannedStage> stages;
  for (const PlannedStudy& planned : studies) {
    stages.push_back({StageOf(planned.study), WorkLeft(planned.plan, remeasure)});
  }
  return stages;
}

void WritePage(const StudyRequest& request, const ExperimentArguments& arguments) {
  WriteReproduction(request, arguments.output);
  if (arguments.run.quiet) return;
  fmt::print("Wrote {}\n", (arguments.output / "reproduction.md").string());
}

// Chosen: one seed of all studies takes hours already.
StudyRequest WithSeedsOfPage(StudyRequest request) {
  if (!request.quick && request.seeds == 0) request.seeds = 1;
  return request;
}

int RunExperiment(const ExperimentArguments& arguments) {
  RequireApart({arguments.baseline}, arguments.output);
  const bool wants_page = WantsPage(arguments.names);
  const StudyRequest request =
      wants_page ? WithSeedsOfPage(RequestOf(arguments)) : RequestOf(arguments);
  std::vector<PlannedStudy> studies;
  for (const Study& study : StudiesOf(arguments.names)) {
    studies.push_back(Planned(study, request, arguments));
  }
  MakeOutputFolder(arguments.output);
  LimitThreads(arguments.run);
  const RunLock lock(arguments.output / "curvefusion.lock", arguments.output);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  printer.Plan(StagesOf(studies, arguments.runner.remeasure));
  int exit_code = 0;
  for (const PlannedStudy& study : studies) {
    exit_code = std::max(exit_code, RunOne(study, request, arguments, printer));
  }
  if (wants_page) WritePage(request, arguments);
  return exit_code;
}

std::string StudyList() {
  std::string text = "Studies:\n";
  for (const Study& study : AllStudies()) {
    text += fmt::format("  {:<18} {}\n", study.name, study.summary);
  }
  return text +
         fmt::format("  {:<18} {}\n  {:<18} {}\n", kAll,
                     "Every study that tests a claim of the paper, then the page reproduction.md",
                     kReproduction, "That page again, from the runs that are finished");
}

void AddRequestOptions(CLI::App& command, ExperimentArguments& arguments) {
  command.add_flag("--quick", arguments.request.quick, "Fewer frames, cases and seeds");
  command.add_option("--profile", arguments.profile, "paper, best or both (default)")
      ->check(CLI::IsMember({"paper", "best", "both"}));
  command
      .add_option("--seeds", arguments.request.seeds,
                  "Number of seeds; otherwise 3, of quick studies, all and reproduction 1")
      ->check(CLI::Range(1, 99));
  command
      .add_option("--split", arguments.split,
                  "train (default): seeds from 1, on which constants may be chosen; validation: "
                  "seeds from 201, to see whether they carry; test: seeds from 101, for final "
                  "figures only")
      ->check(CLI::IsMember(SplitNames()));
  command
      .add_option(
          "--set", arguments.request.assignments,
          "A setting of the reconstruction as section.key=value; may be given several times")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--objects", arguments.request.objects,
                  "Objects of the studies objects, bundle-size and comparisons, or families of "
                  "the studies families and ablation, separated by commas")
      ->delimiter(',');
  command
      .add_option("--sensor", arguments.request.sensor,
                  "Of the studies families and ablation: all scans by this camera")
      ->check(CLI::IsMember(SensorNames()));
  command
      .add_option(
          "--scans", arguments.request.scans,
          "Folders of good real scans for the studies check, sensor-validation and families, "
          "separated by commas; families compares with SCAN/truth or SCAN.truth where it is there")
      ->delimiter(',')
      ->check(CLI::ExistingDirectory);
  command
      .add_option("--data", arguments.request.data,
                  "A folder whose sim/ and real/ hold more scans for the study families")
      ->check(CLI::ExistingDirectory);
}

}  // namespace

void AddExperimentCommand(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("experiment", "Run a study of the paper on simulated scans");
  const auto arguments = std::make_shared<ExperimentArguments>();
  command->add_option("NAME", arguments->names, "Studies, see below, all, or reproduction")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Folder for scans, runs, tables and figures; finished runs in it are kept")
      ->required();
  AddRequestOptions(*command, *arguments);
  command
      ->add_option("--jobs", arguments->runner.jobs,
                   "Scans worked on at the same time; more than 1 distorts times and memory")
      ->check(CLI::Range(1, 64));
  command->add_flag("--remeasure", arguments->runner.remeasure,
                    "Measure again what another revision of this program has measured");
  command
      ->add_option(
          "--cache", arguments->runner.caches,
          "Folder of a sweep, or another that may have finished cells and scans; new ones go "
          "to the first that can be written; may be given several times")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(CLI::ExistingDirectory);
  command->add_option("--baseline", arguments->baseline,
                      "Folder of an earlier call: compares the same runs and exits with 1 where a "
                      "figure is worse by more than the tolerance");
  command
      ->add_option("--tolerance", arguments->tolerance,
                   "With --baseline: the largest loss that passes, of shares and of mm of diameter "
                   "(otherwise 0.02)")
      ->check(CLI::Range(0.0, 1.0));
  AddRunOptions(*command, arguments->run);
  command->footer(StudyList() +
                  "Example:\n  curvefusion experiment objects -o studies --quick\n"
                  "  curvefusion experiment all -o studies --quick\n"
                  "  curvefusion experiment inter-wire -o studies --seeds 1 --set "
                  "fusion.overlap_distance=0.008 --profile paper\n"
                  "  curvefusion experiment families -o families --profile best --split test\n"
                  "  curvefusion experiment objects -o now --objects cage,cat --baseline before");
  command->callback([arguments, &exit_code] { exit_code = RunExperiment(*arguments); });
}

}  // namespace curvefusion
