#include "experiments/studies/regression_check.h"

#include <fmt/format.h>

#include <cassert>

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/case_settings.h"
#include "experiments/studies/headline_figures.h"
#include "experiments/studies/run_files.h"
#include "experiments/studies/study_runner.h"
#include "kernel/error.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

StudyRun BaselineRun(const fs::path& folder, const StudyCase& study_case) {
  const std::optional<RunFile> file = ReadRunFile(folder);
  if (!file || file->run.outcome == "failed") {
    throw Error(ErrorKind::kBadInput, folder.string() +
                                          ": the baseline lacks this run; measure it with the same "
                                          "objects, seeds and settings");
  }
  const std::string scan = study_case.scan ? ScanSettings(*study_case.scan) : "null";
  if (file->settings.find("\"scan\":" + scan) == std::string::npos) {
    throw Error(ErrorKind::kBadInput,
                folder.string() + ": measured on another scan; measure the baseline again");
  }
  return file->run;
}

std::vector<std::string> LabelsBesidesObject(const std::vector<StudyRun>& runs) {
  std::vector<std::string> names;
  if (runs.empty()) return names;
  for (const auto& [name, value] : runs.front().labels) {
    if (name != "object") names.push_back(name);
  }
  return names;
}

bool IsFallen(const HeadlineFigure& figure, const std::optional<double>& before,
              const std::optional<double>& now, double tolerance) {
  if (figure.is_cost || !before) return false;
  if (!now) return true;
  return (figure.more_is_better ? *before - *now : *now - *before) > tolerance;
}

std::string Number(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

// A row for every figure of a group.
void AddRows(const RunGroup& before_group, const RunGroup& now_group, double tolerance,
             RegressionCheck& check) {
  const auto before = HeadlineValues(before_group);
  const auto now = HeadlineValues(now_group);
  for (size_t f = 0; f < before.size(); ++f) {
    const HeadlineFigure& figure = HeadlineFigures()[f];
    const bool fell = IsFallen(figure, before[f], now[f], tolerance);
    const bool has_ratio = before[f] && now[f] && *before[f] != 0;
    std::vector<std::string> row;
    for (const auto& [name, value] : now_group.labels) row.push_back(value);
    row.insert(
        row.end(),
        {figure.name, Number(before[f], figure.decimals), Number(now[f], figure.decimals),
         has_ratio ? fmt::format("{:.3f}", *now[f] / *before[f]) : "-", fell ? "worse" : ""});
    check.table.rows.push_back(row);
    check.fell = check.fell || fell;
  }
}

}  // namespace

std::vector<StudyRun> ReadBaseline(const Study& study, const StudyRequest& request,
                                   const fs::path& baseline) {
  std::vector<StudyRun> runs;
  for (const StudyCase& study_case : study.cases(request)) {
    runs.push_back(BaselineRun(RunFolder(study, request, baseline, study_case), study_case));
  }
  return runs;
}

RegressionCheck CompareWithBaseline(const std::vector<StudyRun>& before,
                                    const std::vector<StudyRun>& now, double tolerance) {
  const std::vector<std::string> labels = LabelsBesidesObject(now);
  const std::vector<RunGroup> before_groups = GroupRuns(before, labels);
  const std::vector<RunGroup> now_groups = GroupRuns(now, labels);
  assert(before_groups.size() == now_groups.size());
  RegressionCheck check;
  check.table.headings = labels;
  check.table.text_columns = labels.size() + 1;
  for (const char* heading : {"figure", "before", "now", "ratio", "judged"}) {
    check.table.headings.emplace_back(heading);
  }
  for (size_t i = 0; i < now_groups.size(); ++i) {
    AddRows(before_groups[i], now_groups[i], tolerance, check);
  }
  return check;
}

}  // namespace curvefusion
