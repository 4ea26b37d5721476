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
constexpr double kCharacter = 0.067;  // inches, of that font

// Names of bars stand aslant under each panel, or, where they are long, upright under the last row.
struct NameLayout {
  bool is_upright = false;
  double height = 4.2;  // of the picture, inches
  double bottom = 0.155, top = 0.89, gap = 0.25;
};

NameLayout LayoutFor(const std::vector<StudyRun>& runs, size_t panel_rows) {
  size_t longest = 0;
  for (const StudyRun& run : runs) longest = std::max(longest, LabelOf(run.labels, "row").size());
  if (longest <= kLongName) return {};
  const double names = kCharacter * static_cast<double>(longest) + 0.1;
  const double height = 1.6 * static_cast<double>(panel_rows) + names + 0.46;
  return {true, height, names / height, 1 - 0.46 / height, 0.36 / height};
}

std::string PlotCommands(const std::vector<StudyRun>& runs, const std::vector<RunGroup>& profiles,
                         size_t row_count, const std::vector<BarPanel>& panels,
                         const NameLayout& layout) {
  std::string commands =
      fmt::format("set xrange [-0.6:{:.1f}]\n", static_cast<double>(row_count) - 0.4) +
      fmt::format("set datafile missing '?'\nset xtics noenhanced rotate by {} right scale 0\n",
                  layout.is_upright ? 90 : 35) +
      "unset grid\n"
      "set grid ytics linecolor rgb '#DDDDDD' linewidth 0.6 dashtype 1\n"
      "set errorbars small linecolor rgb '#222222' linewidth 0.9\nset style fill solid 0.85 "
      "noborder\n" +
      fmt::format(
          "set multiplot layout {},2 margins 0.055,0.99,{:.3f},{:.3f} spacing 0.065,{:.3f}\n",
          (panels.size() + 1) / 2, layout.bottom, layout.top, layout.gap);
  for (size_t i = 0; i < panels.size(); ++i) {
    const BarPanel& panel = panels[i];
    const size_t column = 2 + 3 * i;  // of the data
    commands += fmt::format(
        "set title '{}' offset 0,-0.6\nset yrange [0:{}]\n{}\n", panel.title,
        GreatestOf(runs, panel.figure, panel.least_top),
        i == 0 ? "set key at screen 0.5,0.985 center top horizontal maxrows 1" : "unset key");
    const bool has_names = !layout.is_upright || i + 2 >= panels.size();
    std::vector<std::string> parts = {fmt::format(
        "data index 0 using 0:(0):xtic({}) with points pointsize 0", has_names ? "1" : "''")};
    for (size_t p = 0; p < profiles.size(); ++p) {
      const double shift = (static_cast<double>(p) - (profiles.size() - 1) / 2.) * 0.38;
      parts.push_back(fmt::format(
          "data index {0} using ($0{1:+}):{2}:{3}:{4}:(0.36) with boxerrorbars lt {5} title '{6}'",
          p, shift, column, column + 1, column + 2, p + 1, profiles[p].labels.front().second));
    }
    commands += fmt::format("plot {}\n", fmt::join(parts, ", "));
  }
  return commands + "unset multiplot";
}

}  // namespace

void DrawBarPanels(const StudyResults& results, const std::vector<std::string>& rows,
                   const std::vector<BarPanel>& panels) {
  const std::vector<StudyRun> runs = WithRows(results.runs, rows);
  const std::vector<RunGroup> groups = GroupRuns(runs, {"row", "profile"});
  const std::vector<RunGroup> profiles = GroupRuns(runs, {"profile"});
  const NameLayout layout = LayoutFor(runs, (panels.size() + 1) / 2);
  DrawPlot(results.folder, results.stem,
           {SpreadBlocks(groups, "profile", "row", FiguresOf(panels)),
            PlotCommands(runs, profiles, groups.size() / profiles.size(), panels, layout), 6.5,
            layout.height});
}

}  // namespace curvefusion
