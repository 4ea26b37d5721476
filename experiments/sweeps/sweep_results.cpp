#include "experiments/sweeps/sweep_results.h"

#include <fmt/format.h>

#include <set>

#include "experiments/csv_cell.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/run_files.h"
#include "experiments/sweeps/settings_report.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

// Those that differ from run to run, or from machine to machine.
bool IsCost(const std::string& figure) {
  return figure.find("seconds") != std::string::npos || figure.starts_with("peak_memory") ||
         figure == "contraction_share";  // of the seconds
}

CellResult ResultOf(const SweepPlan& plan, const SweepCell& cell) {
  CellResult result{cell, {}};
  const std::filesystem::path folder = FinishedResult(plan, cell);
  const auto file = folder.empty() ? std::nullopt : ReadRunFile(folder);
  if (file) result.run = file->run;
  if (!file) result.run.outcome = kMissing;
  result.run.seed = cell.seed;
  // What another sweep called the same scan does not matter here.
  result.run.labels = {{"object", cell.object},
                       {"profile", ProfileName(cell.profile)},
                       {"setting", SettingName(cell)}};
  return result;
}

std::set<std::string> FiguresOf(const std::vector<CellResult>& results, bool costs) {
  std::set<std::string> names;
  for (const CellResult& result : results) {
    for (const auto& [name, value] : result.run.figures) {
      if (IsCost(name) == costs) names.insert(name);
    }
  }
  return names;
}

std::string FigureCells(const StudyRun& run, const std::set<std::string>& figures) {
  std::string text;
  for (const std::string& figure : figures) {
    const auto found = run.figures.find(figure);
    text += found == run.figures.end() ? "," : fmt::format(",{}", found->second);
  }
  return text + "\n";
}

std::string Heading(const std::string& names, const std::set<std::string>& figures) {
  std::string text = names;
  for (const std::string& figure : figures) text += "," + figure;
  return text + "\n";
}

std::string TableText(const std::vector<CellResult>& results) {
  const std::set<std::string> figures = FiguresOf(results, false);
  std::string text =
      Heading("cell,object,seed,sensor,poses,profile,setting,scan,outcome,message", figures);
  for (const auto& [cell, run] : results) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}", cell.key, cell.object, cell.seed,
                        cell.sensor, cell.poses, ProfileName(cell.profile),
                        CsvCell(SettingName(cell)), cell.scan, run.outcome, CsvCell(run.message)) +
            FigureCells(run, figures);
  }
  return text;
}

void WriteCosts(const SweepPlan& plan, const std::vector<CellResult>& results) {
  const std::set<std::string> figures = FiguresOf(results, true);
  WriteStreamAtomically(plan.folder / "costs.csv", [&](std::ostream& stream) {
    stream << Heading("cell,revision,result", figures);
    for (const auto& [cell, run] : results) {
      if (run.outcome == kMissing) continue;
      stream << fmt::format("{},{},{}", cell.key, run.revision, CsvCell(run.folder.string()))
             << FigureCells(run, figures);
    }
  });
}

bool HasGnuplot(std::string& why_not) {
  try {
    RequireGnuplot();
  } catch (const Error& error) {
    why_not = error.what();
  }
  return why_not.empty();
}

}  // namespace

std::vector<CellResult> ReadCellResults(const SweepPlan& plan) {
  std::vector<CellResult> results;
  for (const SweepCell& cell : plan.cells) results.push_back(ResultOf(plan, cell));
  return results;
}

SweepStatus StatusOf(const SweepPlan& plan, const std::vector<CellResult>& results) {
  SweepStatus status;
  std::set<std::string> scans;
  for (const auto& [cell, run] : results) {
    ++status.cells;
    status.done += run.outcome == "done" ? 1 : 0;
    status.nothing_found += run.outcome == "nothing found" ? 1 : 0;
    status.missing += run.outcome == kMissing ? 1 : 0;
    if (run.outcome == "failed") {
      ++status.failed;
      status.failures.push_back(fmt::format("{} ({}, seed {}, {}, {}): {}", cell.key, cell.object,
                                            cell.seed, ProfileName(cell.profile), SettingName(cell),
                                            run.message));
    }
    if (!scans.insert(cell.scan).second) continue;
    ++status.scans;
    status.missing_scans += FinishedScan(plan, cell.scan).empty() ? 1 : 0;
  }
  return status;
}

std::string CollectSweep(const SweepPlan& plan, const std::vector<CellResult>& results, bool anew) {
  const std::filesystem::path path = plan.folder / "table.csv";
  const std::string table = TableText(results);
  if (!anew && std::filesystem::exists(path) && ReadFile(path) == table) return {};
  WriteCosts(plan, results);
  std::string why_not;
  const bool draws = HasGnuplot(why_not);
  for (const Profile profile : {Profile::kPaper, Profile::kBest}) {
    StudyResults measured{plan.folder, "settings_" + ProfileName(profile), {}};
    for (const auto& [cell, run] : results) {
      if (cell.profile == profile && run.outcome != kMissing) measured.runs.push_back(run);
    }
    if (!measured.runs.empty()) ReportSettings(measured, draws);
  }
  WriteStreamAtomically(path, [&](std::ostream& stream) { stream << table; });
  return why_not;
}

}  // namespace curvefusion
