// What every deviation of the best profile from the paper is worth on random scans of all families:
// each is switched off in turn. Nothing is chosen by it, so that it may be reported on the test
// split too.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/ablations.h"
#include "experiments/studies/change_chart.h"
#include "experiments/studies/headline_figures.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

constexpr const char* kNothing = "nothing";

struct Variant {
  Labels labels;  // what it is without
  std::vector<std::string> assignments;
};

std::vector<Variant> Variants() {
  std::vector<Variant> variants = {{{{"without", kNothing}}, {}}};
  for (const Ablation& ablation : Ablations()) {
    variants.push_back({{{"without", ablation.name}}, ablation.off});
  }
  return variants;
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  const std::vector<Variant> variants = Variants();
  std::vector<StudyCase> cases;
  for (const std::string& family : FamiliesOf(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      for (const Variant& variant : variants) {
        Labels labels = {{"object", family}};
        labels.insert(labels.end(), variant.labels.begin(), variant.labels.end());
        cases.push_back({labels, seed, FamilyScan(request, family, seed),
                         CaseConfig(request, Profile::kBest, variant.assignments)});
      }
    }
  }
  return cases;
}

std::string CellText(const std::optional<double>& value, int decimals, bool is_change) {
  if (!value) return "-";
  return is_change ? fmt::format("{:+.{}f}", *value, decimals)
                   : fmt::format("{:.{}f}", *value, decimals);
}

Table PurposeTable() {
  Table table{{"without", "set", "what it is for"}, {}, 3};
  for (const Ablation& ablation : Ablations()) {
    table.rows.push_back(
        {ablation.name, fmt::format("{}", fmt::join(ablation.off, " ")), ablation.purpose});
  }
  return table;
}

void Report(const StudyResults& results) {
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"without"});
  std::vector<std::vector<std::optional<double>>> values;
  std::vector<ChangeRow> changes;
  for (const RunGroup& group : groups) {
    values.push_back(HeadlineValues(group));
    if (&group == &groups.front()) continue;
    values.back() = ChangesOf(values.front(), values.back());
    changes.push_back({LabelOf(group.labels, "without"), values.back()});
  }
  Table table = MedianTable(groups, {});
  AddHeadlineColumns(table, [&](size_t row, size_t figure) {
    return CellText(values[row][figure], HeadlineFigures()[figure].decimals, row > 0);
  });
  WriteTable(results.folder, results.stem, table);
  WriteTable(results.folder, results.stem + "_purposes", PurposeTable());
  DrawChanges(results.folder, results.stem, changes);
}

}  // namespace

Study AblationStudy() {
  return {"ablation",
          "What each deviation of the best profile from the paper is worth",
          Cases,
          {},
          Report};
}

}  // namespace curvefusion
