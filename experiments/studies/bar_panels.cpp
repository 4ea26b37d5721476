#include "experiments/studies/bar_panels.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/studies/gnuplot.h"
#include "experiments/studies/result_table.h"

namespace curvefusion {

namespace {

// The runs with one more label, "row".
std::vector<StudyRun> WithRows(std::vector<StudyRun> runs, const std::vector<std::string>& rows) {
  for (StudyRun& run : runs) {
    std::vector<std::string> values;
    for (const std::string& row : rows) values.push_back(LabelOf(run.labels, row));
    run.labels.emplace_back("row", fmt::format("{}", fmt::join(values, "/")));
  }
  return runs;
}

std::vector<std::string> FiguresOf(const std::vector<BarPanel>& panels) {
  std::vector<std::string> figures;
  for (const BarPanel& panel : panels) figures.push_back(panel.figure);
  return figures;
}

// Names that would leave the picture at 35 degrees, characters; measured on the font of DrawPlot.
constexpr size_t kLongName = 12;

bool HasLongNames(const std::vector<StudyRun>& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const StudyRun& run) {
    return LabelOf(run.labels, "row").size() > kLongName;
  });
}

std::string PlotCommands(const std::vector<StudyRun>& runs, const std::vector<RunGroup>& profiles,
                         size_t row_count, const std::vector<BarPanel>& panels) {
  const bool is_long = HasLongNames(runs);
  std::string commands =
      fmt::format("set xrange [-0.6:{:.1f}]\n", static_cast<double>(row_count) - 0.4) +
      fmt::format("set datafile missing '?'\nset xtics noenhanced rotate by {} right scale 0\n",
                  is_long ? 60 : 35) +
      "unset grid\n"
      "set grid ytics linecolor rgb '#DDDDDD' linewidth 0.6 dashtype 1\n"
      "set errorbars small linecolor rgb '#222222' linewidth 0.9\nset style fill solid 0.85 "
      "noborder\n" +
      fmt::format("set multiplot layout {},2 margins 0.055,0.99,{},0.89 spacing 0.065,{}\n",
                  (panels.size() + 1) / 2, is_long ? 0.21 : 0.155, is_long ? 0.28 : 0.25);
  int column = 2;
  for (const BarPanel& panel : panels) {
    commands += fmt::format(
        "set title '{}' offset 0,-0.6\nset yrange [0:{}]\n{}\n", panel.title,
        GreatestOf(runs, panel.figure, panel.least_top),
        column == 2 ? "set key at screen 0.5,0.985 center top horizontal maxrows 1" : "unset key");
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

}  // namespace

void DrawBarPanels(const StudyResults& results, const std::vector<std::string>& rows,
                   const std::vector<BarPanel>& panels) {
  const std::vector<StudyRun> runs = WithRows(results.runs, rows);
  const std::vector<RunGroup> groups = GroupRuns(runs, {"row", "profile"});
  const std::vector<RunGroup> profiles = GroupRuns(runs, {"profile"});
  DrawPlot(results.folder, results.stem,
           {SpreadBlocks(groups, "profile", "row", FiguresOf(panels)),
            PlotCommands(runs, profiles, groups.size() / profiles.size(), panels), 6.5,
            HasLongNames(runs) ? 5.4 : 4.2});
}

}  // namespace curvefusion
