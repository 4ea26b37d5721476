// The paper's Table 1, row by row: its objects with its own numbers of frames, and the cloth hanger
// that "was scanned in 1,136 frames" (CurveFusion 5).
#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/bar_panels.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

struct TableRow {
  const char* name;    // what a run is called
  const char* object;  // our analogue
  int frames;
  int junctions;
  const char* diameters;  // "thickness of wire", mm
  double estimate_mm;     // "estimated thickness of wire"; 0: none is given
  int seconds;            // "reconstruction time (without L1 extraction)"; 0: none is given
};
constexpr TableRow kRows[] = {{"dish rack", "dish", 684, 14, "5; 9", 5.4, 178},
                              {"bird cage", "cage", 227, 50, "4.5", 4.8, 89},
                              {"cat", "cat", 165, 22, "4.5; 6", 5.6, 37},
                              {"decoration", "deco", 330, 14, "5.5", 5.1, 64},
                              {"large hanger", "hanger", 261, 30, "4; 12", 4.5, 86},
                              {"rack", "rack", 180, 32, "5.5; 11", 5.8, 55},
                              {"chair", "chair", 428, 336, "4.5; 12", 4.5, 111},
                              {"wine rack", "wine", 656, 12, "6", 5.4, 142},
                              {"cloth hanger", "hanger", 1136, 30, "4; 12", 0, 0}};
constexpr const char* kQuickRow = "cat";  // the fewest frames

bool IsWanted(const StudyRequest& request, const TableRow& row) {
  if (request.quick) return row.name == std::string(kQuickRow);
  const std::vector<std::string> objects = ObjectsOf(request);
  return std::find(objects.begin(), objects.end(), row.object) != objects.end();
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const TableRow& row : kRows) {
    if (!IsWanted(request, row)) continue;
    for (const uint64_t seed : SeedsOf(request)) {
      SimulationOptions scan = ObjectScan(request, row.object, seed, {row.frames, row.frames});
      for (const Profile profile : request.profiles) {
        cases.push_back(
            {{{"row", row.name}, {"object", row.object}, {"profile", ProfileName(profile)}},
             seed,
             scan,
             CaseConfig(request, profile)});
      }
    }
  }
  return cases;
}

const TableRow& RowNamed(const std::string& name) {
  return *std::find_if(std::begin(kRows), std::end(kRows),
                       [&](const TableRow& row) { return row.name == name; });
}

RunOutcome Run(const RunInput& input) {
  RunOutcome outcome = input.reconstruct(input);
  const double frames = RowNamed(LabelOf(input.study_case.labels, "row")).frames;
  const auto of_bundle = outcome.figures.find("seconds_per_30_frames_without_contraction");
  if (of_bundle != outcome.figures.end())
    outcome.figures["seconds_without_contraction"] = of_bundle->second * frames / 30;
  return outcome;
}

std::string Given(double value, int decimals) {
  return value > 0 ? fmt::format("{:.{}f}", value, decimals) : "-";
}

// A row of the paper's table beside ours.
std::vector<std::string> BesideThePaper(const RunGroup& group) {
  const TableRow& row = RowNamed(LabelOf(group.labels, "row"));
  const auto ours = [&](const char* figure, int decimals) {
    return SpreadText(SpreadOf(group, figure), decimals);
  };
  return {
      row.name,
      LabelOf(group.labels, "profile"),
      fmt::format("{}", row.frames),
      fmt::format("{}", row.junctions),
      ours("aligned.junctions_10mm.matched", 0) + " of " + ours("aligned.junctions_10mm.truth", 0),
      ours("aligned.junctions_10mm.found", 0),
      row.diameters,
      Given(row.estimate_mm, 1),
      ours("global_diameter_mm", 1),
      Given(row.seconds, 0),
      ours("seconds_without_contraction", 0),
      ours("seconds", 0),
      ours("aligned.curves.5mm.f", 2),
      ours("aligned.curves.2mm.f", 2)};
}

void Report(const StudyResults& results) {
  Table table{
      {"object", "profile", "frames", "junctions (paper)", "matched", "found", "thickness (mm)",
       "estimated (paper)", "estimated", "s without L1 (paper)", "s without L1", "s", "F5", "F2"},
      {},
      2};
  for (const RunGroup& group : GroupRuns(results.runs, {"row", "profile"}))
    table.rows.push_back(BesideThePaper(group));
  WriteTable(results.folder, results.stem, table);
  DrawBarPanels(results, {"row"},
                {{"F at 5 mm, aligned", "aligned.curves.5mm.f"},
                 {"F at 2 mm, aligned", "aligned.curves.2mm.f"},
                 {"Junction recall", "aligned.junctions_10mm.recall"},
                 {"Seconds without L1 extraction", "seconds_without_contraction"}});
}

}  // namespace

Study Table1Study() {
  return {"table1", "The paper's Table 1 with its own numbers of frames, and the hanger of 1,136",
          Cases, Run, Report};
}

}  // namespace curvefusion
