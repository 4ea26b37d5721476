// The eight objects of the paper's Table 1: "Our algorithm successfully detects and classifies 95%
// of these junctions and provides a faithful 3D reconstruction" (CurveFusion 4).
#include <fmt/format.h>

#include "experiments/studies/gnuplot.h"
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

struct Panel {
  const char* title;
  const char* figure;
};
constexpr Panel kPanels[] = {{"F at 5 mm, aligned", "aligned.curves.5mm.f"},
                             {"F at 2 mm, aligned", "aligned.curves.2mm.f"},
                             {"Junction recall", "aligned.junctions_10mm.recall"},
                             {"Junction precision", "aligned.junctions_10mm.precision"}};

std::vector<std::string> PanelFigures() {
  std::vector<std::string> figures;
  for (const Panel& panel : kPanels) figures.emplace_back(panel.figure);
  return figures;
}

// Medians as bars, with lines from the least to the greatest value.
std::string PlotCommands(const std::vector<RunGroup>& profiles, size_t objects) {
  std::string commands =
      fmt::format("set xrange [-0.6:{:.1f}]\n", static_cast<double>(objects) - 0.4) +
      "set datafile missing '?'\nset yrange [0:1.05]\nset ytics 0.2\nset xtics rotate by 35 right "
      "scale 0\nunset grid\nset grid ytics linecolor rgb '#DDDDDD' linewidth 0.6 dashtype 1\n"
      "set errorbars small linecolor rgb '#222222' linewidth 0.9\nset style fill solid 0.85 "
      "noborder\n"
      "set multiplot layout 2,2 margins 0.055,0.99,0.115,0.89 spacing 0.065,0.21\n";
  int column = 2;
  for (const Panel& panel : kPanels) {
    const bool first = column == 2;
    commands += fmt::format("set title '{}' offset 0,-0.6\n", panel.title);
    commands +=
        first ? "set key at screen 0.5,0.985 center top horizontal maxrows 1\n" : "unset key\n";
    std::vector<std::string> parts = {"data index 0 using 0:(0):xtic(1) with points pointsize 0"};
    for (size_t i = 0; i < profiles.size(); ++i) {
      const double shift = (static_cast<double>(i) - (profiles.size() - 1) / 2.) * 0.38;
      parts.push_back(fmt::format(
          "data index {0} using ($0{1:+}):{2}:{3}:{4}:(0.36) with boxerrorbars lt {5} title '{6}'",
          i, shift, column, column + 1, column + 2, i + 1, profiles[i].labels.front().second));
    }
    commands += fmt::format("plot {}\n", fmt::join(parts, ", "));
    column += 3;
  }
  return commands + "unset multiplot";
}

void Report(const StudyResults& results) {
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"object", "profile"});
  const std::vector<RunGroup> profiles = GroupRuns(results.runs, {"profile"});
  WriteTable(results.folder, results.stem, MedianTable(groups, kColumns));
  WriteTable(results.folder, results.stem + "_junctions", PooledJunctions(results.runs));
  DrawPlot(results.folder, results.stem,
           {SpreadBlocks(groups, "profile", "object", PanelFigures()),
            PlotCommands(profiles, groups.size() / profiles.size()), 6.5, 4.2});
}

}  // namespace

Study ObjectsStudy() {
  return {
      "objects", "The eight objects of the paper's Table 1: accuracy, junctions, diameters, cost",
      false,     Cases,
      {},        Report};
}

}  // namespace curvefusion
