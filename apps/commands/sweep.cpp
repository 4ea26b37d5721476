#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/commands/command.h"
#include "apps/output_folder.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/sweeps/cell_measurement.h"
#include "experiments/sweeps/paired_comparison.h"
#include "experiments/sweeps/pareto_front.h"
#include "experiments/sweeps/snakemake_run.h"
#include "experiments/sweeps/sweep_plan.h"
#include "experiments/sweeps/sweep_results.h"
#include "kernel/error.h"
#include "kernel/run_lock.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr int kUnfinished = 1;   // exit code: cells failed or are missing
constexpr int kMostListed = 10;  // of cells on the terminal; files have all

struct SweepArguments {
  std::string action;
  std::vector<fs::path> paths;  // a study file, sweeps, a cell's folder, or the settings of a scan
  fs::path output;
  fs::path scan;
  std::string shard;  // "2/4"
  int merge = 0;      // shards
  std::vector<fs::path> caches;
  std::string figure = "F2 aligned";
  std::string setting;
  double tolerance = 0.02;
  SweepRunOptions runner;
  RunOptions run;
};

fs::path ThisFile() { return fs::read_symlink("/proc/self/exe"); }

RunLock LockOf(const fs::path& folder) { return {folder / "curvefusion.lock", folder}; }

int PlanSweep(const SweepArguments& arguments) {
  MakeOutputFolder(arguments.output);
  const RunLock lock = LockOf(arguments.output);
  const SweepPlan plan =
      WriteSweepPlan(arguments.paths[0], arguments.output, arguments.caches, ThisFile());
  const SweepStatus status = StatusOf(plan, ReadCellResults(plan));
  if (arguments.run.quiet) return 0;
  fmt::print("{} cells on {} scans; {} cells and {} scans are there already\n", status.cells,
             status.scans, status.cells - status.missing, status.scans - status.missing_scans);
  fmt::print("Go on with: curvefusion sweep run {}\n", arguments.output.string());
  return 0;
}

int PrintStatus(const SweepStatus& status, bool quiet) {
  if (!quiet) {
    fmt::print("{} cells: {} done, {} found nothing, {} failed, {} missing; {} of {} scans\n",
               status.cells, status.done, status.nothing_found, status.failed, status.missing,
               status.scans - status.missing_scans, status.scans);
  }
  for (int i = 0; i < std::min(status.failed, kMostListed); ++i) {
    fmt::print(stderr, "failed: {}\n", status.failures[i]);
  }
  if (status.failed > kMostListed) {
    fmt::print(stderr, "{} more failed: table.csv has all\n", status.failed - kMostListed);
  }
  if (status.missing > 0) fmt::print(stderr, "{} cells are missing\n", status.missing);
  return status.failed + status.missing > 0 ? kUnfinished : 0;
}

int Collect(const SweepPlan& plan, bool anew, bool quiet) {
  const std::vector<CellResult> results = ReadCellResults(plan);
  const std::string no_figures = CollectSweep(plan, results, anew);
  if (!no_figures.empty()) fmt::print(stderr, "no figures: {}\n", no_figures);
  return PrintStatus(StatusOf(plan, results), quiet);
}

int ShowStatus(const SweepArguments& arguments) {
  const SweepPlan plan = ReadSweepPlan(arguments.paths[0]);
  return PrintStatus(StatusOf(plan, ReadCellResults(plan)), arguments.run.quiet);
}

int CollectAll(const SweepArguments& arguments) {
  const SweepPlan plan = ReadSweepPlan(arguments.paths[0]);
  return Collect(plan, true, arguments.run.quiet);
}

int RunSweep(const SweepArguments& arguments) {
  const SweepPlan plan = ReadSweepPlan(arguments.paths[0]);
  const RunLock lock = LockOf(arguments.paths[0]);
  const SweepStatus before = StatusOf(plan, ReadCellResults(plan));
  if (before.missing > 0) {
    SweepRunOptions options = arguments.runner;
    options.program = ThisFile();
    ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
    MeasureSweep(plan, options, InterruptibleProgress(printer));
    printer.Finish();
  }
  const int outcome = Collect(plan, false, arguments.run.quiet);
  if (outcome != 0) {
    fmt::print(stderr, "the same command goes on; {} has what Snakemake said\n",
               (plan.folder / ".snakemake" / "log").string());
  }
  if (!arguments.run.quiet && outcome == 0) {
    fmt::print("Wrote {}\n", (plan.folder / "table.csv").string());
  }
  return outcome;
}

int CompareTwo(const SweepArguments& arguments) {
  const auto before = ReadCellResults(ReadSweepPlan(arguments.paths[0]));
  const auto after = ReadCellResults(ReadSweepPlan(arguments.paths[1]));
  const std::optional<std::string> setting =
      arguments.setting.empty() ? std::nullopt : std::optional(arguments.setting);
  const SweepComparison comparison = CompareSweeps(before, after, arguments.tolerance, setting);
  if (comparison.figures.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{} and {} have no measured cell in common: the same scan, profile and "
                            "setting{}",
                            arguments.paths[0].string(), arguments.paths[1].string(),
                            setting ? fmt::format(" ({} against the default)", *setting) : ""));
  }
  fmt::print("{}", MarkdownTable(ComparisonTable(comparison)));
  int listed = 0;
  for (const WorseCell& cell : comparison.worse) {
    if (++listed > kMostListed) break;
    fmt::print("{}", WorseCellText(cell));
  }
  if (comparison.unpaired > 0) fmt::print("{} cells have no partner\n", comparison.unpaired);
  if (!arguments.output.empty()) {
    MakeFolderOf(arguments.output);
    WriteWorseCells(arguments.output, comparison);
  }
  return 0;
}

int FindBest(const SweepArguments& arguments) {
  const HeadlineFigure& figure = AccuracyFigure(arguments.figure);
  const SweepPlan plan = ReadSweepPlan(arguments.paths[0]);
  const ParetoFront front = FindParetoFront(ReadCellResults(plan), figure);
  RequireGnuplot();
  WriteParetoFront(plan.folder, front, figure);
  if (arguments.run.quiet) return 0;
  fmt::print("{}", MarkdownTable(ParetoTable(front, figure)));
  for (const std::string& name : front.left_out) {
    fmt::print("not measured on every scan: {}\n", name);
  }
  fmt::print("Wrote {} (.csv, .md, .tex, .png, .pdf)\n", (plan.folder / "pareto").string() + "*");
  return 0;
}

int RunCellShard(const SweepArguments& arguments, const SweepCell& cell) {
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const std::string why =
      MeasureCellShard(cell, arguments.scan, arguments.output, ParseShard(arguments.shard),
                       InterruptibleProgress(printer));
  printer.Finish();
  if (!why.empty()) fmt::print(stderr, "curvefusion: cell {} is not split: {}\n", cell.key, why);
  return 0;  // the cell is measured whole
}

int RunCell(const SweepArguments& arguments) {
  LimitThreads(arguments.run);
  const SweepCell cell = ReadParams(arguments.paths[0] / "params.toml");
  if (!arguments.shard.empty()) return RunCellShard(arguments, cell);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  const CellOutcome outcome = MeasureCell(cell, arguments.scan, arguments.output,
                                          InterruptibleProgress(printer), arguments.merge);
  printer.Finish();
  if (!outcome.message.empty()) {
    fmt::print(stderr, "curvefusion: cell {} failed: {}\n", cell.key, outcome.message);
  }
  return 0;  // measured, whatever came out
}

int MakeScan(const SweepArguments& arguments) {
  LimitThreads(arguments.run);
  ProgressPrinter printer = MakeProgressPrinter(arguments.run.quiet);
  MakeSweepScan(arguments.paths[0], arguments.output, InterruptibleProgress(printer));
  printer.Finish();
  return 0;
}

using Action = int (*)(const SweepArguments&);

struct NamedAction {
  const char* name;
  size_t paths;  // how many it takes
  const char* wants;
  bool writes;  // where -o tells
  Action act;
};

constexpr NamedAction kActions[] = {{"plan", 1, "STUDY.toml -o DIR", true, PlanSweep},
                                    {"run", 1, "DIR", false, RunSweep},
                                    {"status", 1, "DIR", false, ShowStatus},
                                    {"collect", 1, "DIR", false, CollectAll},
                                    {"compare", 2, "DIR DIR", false, CompareTwo},
                                    {"best", 1, "DIR", false, FindBest},
                                    {"scan", 1, "scans/NAME.json -o FOLDER", true, MakeScan},
                                    {"cell", 1, "cells/KEY --scan SCAN -o FOLDER", true, RunCell}};

std::vector<std::string> ActionNames() {
  std::vector<std::string> names;
  for (const NamedAction& action : kActions) names.emplace_back(action.name);
  return names;
}

int RunAction(const SweepArguments& arguments) {
  for (const NamedAction& action : kActions) {
    if (action.name != arguments.action) continue;
    if (arguments.paths.size() == action.paths && (!action.writes || !arguments.output.empty())) {
      return action.act(arguments);
    }
    throw Error(ErrorKind::kUsage,
                fmt::format("write: curvefusion sweep {} {}", action.name, action.wants));
  }
  return 0;  // the command line takes no other name
}

void AddRunnerOptions(CLI::App& command, SweepArguments& arguments) {
  command
      .add_option(
          "--cache", arguments.caches,
          "With plan: another folder that may have finished cells and scans, such as another "
          "sweep; new ones go to the first that can be written; may be given several times")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--jobs", arguments.runner.jobs,
                  "With run: cores to use (default all); with --slurm, jobs in its queue at a time "
                  "(default 64)")
      ->check(CLI::Range(1, 10000));
  command.add_flag("--slurm", arguments.runner.slurm,
                   "With run: every scan and cell is a job of Slurm; all machines see the folder");
}

void AddJudgingOptions(CLI::App& command, SweepArguments& arguments) {
  command.add_option(
      "--setting", arguments.setting,
      "With compare: this setting of the second sweep, as table.csv writes it, against "
      "the default of the first");
  command
      .add_option("--tolerance", arguments.tolerance,
                  "With compare: beyond this a cell is worse; of shares and of millimetres of "
                  "diameter, of time a share; otherwise 0.02")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--figure", arguments.figure,
                     "With best: the accuracy, as the tables name it; otherwise \"F2 aligned\"");
}

}  // namespace

void AddSweepCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "sweep", "Measure many settings on many simulated scans, on one machine or many");
  const auto arguments = std::make_shared<SweepArguments>();
  command->add_option("ACTION", arguments->action, "What to do, see below")
      ->required()
      ->check(CLI::IsMember(ActionNames()));
  command->add_option("PATH", arguments->paths, "A study file or the folder of a sweep")
      ->required();
  command->add_option(
      "-o,--output", arguments->output,
      "With plan: the folder of the sweep; of compare: a CSV file of all pairs that "
      "are worse; of scan and cell: the result");
  AddRunnerOptions(*command, *arguments);
  AddJudgingOptions(*command, *arguments);
  command->add_option("--scan", arguments->scan, "With cell: the folder of its scan");
  command->add_option("--shard", arguments->shard,
                      "With cell: i/N, one shard of it alone, which goes beside the result");
  command
      ->add_option("--merge", arguments->merge,
                   "With cell: put its N shards together, if all are there")
      ->check(CLI::Range(1, 1000));
  AddRunOptions(*command, arguments->run);
  command->footer(
      "Actions:\n"
      "  plan STUDY.toml -o DIR   a folder with a cell for every setting, scan and profile\n"
      "  run DIR                  measure what is missing (needs snakemake), then collect\n"
      "  status DIR               how far it is; exit code 1 while cells are missing or failed\n"
      "  collect DIR              table.csv, costs.csv, and tables and figures by setting\n"
      "  compare DIR DIR          the same cells of two sweeps, pair by pair\n"
      "  best DIR                 which settings give the most accuracy for their time\n"
      "  scan, cell               one step of the work, as the Snakefile calls them\n"
      "Example:\n  curvefusion sweep plan study.toml -o sweep --cache /shared/sweeps\n"
      "  curvefusion sweep run sweep --slurm --jobs 200\n"
      "  curvefusion sweep compare before sweep -o worse.csv\n"
      "  curvefusion sweep compare sweep sweep --setting bundle.min_frames=3\n"
      "  curvefusion sweep best sweep --figure \"F1 aligned\"");
  command->callback([arguments, &exit_code] { exit_code = RunAction(*arguments); });
}

}  // namespace curvefusion
