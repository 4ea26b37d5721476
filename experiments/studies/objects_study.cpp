// The eight objects of the paper's Table 1 in scans of one length, of as many seeds as are asked
// for: how accurate is it, and how much of that is chance? The paper's own lengths: table1.
#include <fmt/format.h>

#include "experiments/studies/bar_panels.h"
#include "experiments/studies/result_table.h"
#include "experiments/studies/studies.h"

namespace curvefusion {

namespace {

std::vector<StudyCase> Cases(const StudyRequest& request) {
  std::vector<StudyCase> cases;
  for (const std::string& object : ObjectsOf(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      for (const Profile profile : request.profiles) {
        cases.push_back({{{"object", object}, {"profile", ProfileName(profile)}},
                         seed,
                         ObjectScan(request, object, seed),
                         CaseConfig(request, profile)});
      }
    }
  }
  return cases;
}

const std::vector<TableColumn> kColumns = {
    {"F5", "raw.curves.5mm.f"},
    {"F2", "raw.curves.2mm.f"},
    {"F5 aligned", "aligned.curves.5mm.f"},
    {"F2 aligned", "aligned.curves.2mm.f"},
    {"junction recall", "aligned.junctions_10mm.recall"},
    {"junction precision", "aligned.junctions_10mm.precision"},
    {"valence right", "aligned.junctions_10mm.valence_share"},
    {"main piece R10", "main_piece.aligned.curves.10mm.recall"},
    {"main piece junction recall", "main_piece.aligned.junctions_10mm.recall"},
    {"main piece junction precision", "main_piece.aligned.junctions_10mm.precision"},
    {"false length (m)", "aligned.curves.false_length"},
    {"pieces", "components", 0},
    {"cycles", "cycles", 0},
    {"true cycles", "true_cycles", 0},
    {"diameter error (mm)", "raw.diameter.mean_error_mm"},
    {"s per 30 frames", "seconds_per_30_frames", 1},
    {"CPU s per 30 frames", "cpu_seconds_per_30_frames", 1},
    {"memory (MB)", "peak_memory_mb", 0}};

std::string Share(double part, double whole) {
  return whole > 0 ? fmt::format("{:.3f}", part / whole) : "-";
}

// Junctions of all objects and seeds together, as the paper counts its 95 %.
Table PooledJunctions(const std::vector<StudyRun>& runs) {
  Table table{{"profile", "placed", "within", "true", "found", "matched", "recall", "precision",
               "valence right"},
              {},
              3};
  for (const RunGroup& group : GroupRuns(runs, {"profile"})) {
    for (const char* placed : {"raw", "aligned"}) {
      for (const char* radius : {"10mm", "5mm"}) {
        const auto sum = [&](const char* count) {
          return SumOf(group, fmt::format("{}.junctions_{}.{}", placed, radius, count));
        };
        const double truth = sum("truth"), found = sum("found"), matched = sum("matched");
        table.rows.push_back({group.labels.front().second, placed, radius,
                              fmt::format("{:.0f}", truth), fmt::format("{:.0f}", found),
                              fmt::format("{:.0f}", matched), Share(matched, truth),
                              Share(matched, found), Share(sum("valence_right"), truth)});
      }
    }
  }
  return table;
}

void Report(const StudyResults& results) {
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"object", "profile"});
  WriteTable(results.folder, results.stem, MedianTable(groups, kColumns));
  WriteTable(results.folder, results.stem + "_junctions", PooledJunctions(results.runs));
  DrawBarPanels(results, {"object"},
                {{"F at 5 mm, aligned", "aligned.curves.5mm.f"},
                 {"F at 2 mm, aligned", "aligned.curves.2mm.f"},
                 {"Junction recall", "aligned.junctions_10mm.recall"},
                 {"Junction precision", "aligned.junctions_10mm.precision"}});
}

}  // namespace

Study ObjectsStudy() {
  return {"objects",
          "The eight objects of the paper's Table 1, 150 frames each: accuracy, junctions, "
          "diameters, cost",
          Cases,
          {},
          Report};
}

}  // namespace curvefusion
