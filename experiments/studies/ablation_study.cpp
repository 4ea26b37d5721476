// What every deviation of the best profile from the paper is worth: each is switched off in turn.
// Nothing is chosen by it, so that it may be reported on the test split too.
#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/ablations.h"
#include "experiments/studies/change_chart.h"
#include "experiments/studies/headline_figures.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

constexpr const char* kFull = "full profile";
constexpr const char* kNothing = "nothing";

struct Variant {
  Labels labels;  // what it is without, and what it is compared with
  std::vector<std::string> assignments;
};

std::vector<Variant> Variants() {
  const std::vector<Ablation> ablations = Ablations();
  const auto carried = std::find_if(ablations.begin(), ablations.end(),
                                    [](const Ablation& a) { return a.name == kCarriedPoints; });
  std::vector<Variant> variants = {{{{"without", kNothing}, {"against", "-"}}, {}}};
  for (const Ablation& ablation : ablations) {
    Variant variant{{{"without", ablation.name}, {"against", kFull}}, {}};
    if (ablation.of_fusion) {
      variant.labels.back().second = std::string("without ") + kCarriedPoints;
      variant.assignments = carried->off;
    }
    variant.assignments.insert(variant.assignments.end(), ablation.off.begin(), ablation.off.end());
    variants.push_back(variant);
  }
  return variants;
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  const std::vector<Variant> variants = Variants();
  std::vector<StudyCase> cases;
  for (const std::string& object : ObjectsOf(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      for (const Variant& variant : variants) {
        Labels labels = {{"object", object}};
        labels.insert(labels.end(), variant.labels.begin(), variant.labels.end());
        cases.push_back({labels, seed, ObjectScan(request, object, seed),
                         CaseConfig(request, Profile::kBest, variant.assignments)});
      }
    }
  }
  return cases;
}

const RunGroup& ReferenceOf(const RunGroup& group, const std::vector<RunGroup>& groups) {
  const bool is_of_fusion = LabelOf(group.labels, "against") != kFull;
  const char* name = is_of_fusion ? kCarriedPoints : kNothing;
  return *std::find_if(groups.begin(), groups.end(), [&](const RunGroup& other) {
    return LabelOf(other.labels, "without") == name;
  });
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
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"without", "against"});
  std::vector<std::vector<std::optional<double>>> values;
  std::vector<ChangeRow> changes;
  for (const RunGroup& group : groups) {
    values.push_back(HeadlineValues(group));
    if (&group == &groups.front()) continue;
    values.back() = ChangesOf(HeadlineValues(ReferenceOf(group, groups)), values.back());
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
  return {"ablation", "What each deviation of the best profile from the paper is worth",
          false,      Cases,
          {},         Report};
}

}  // namespace curvefusion
