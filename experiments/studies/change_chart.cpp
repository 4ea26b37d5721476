#include "experiments/studies/change_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "experiments/studies/gnuplot.h"
#include "experiments/studies/headline_figures.h"

namespace curvefusion {

namespace {

// The headline figures that are drawn, and how wide a panel is at least: smaller changes are not
// blown up to the panel's width.
struct Panel {
  const char* figure;
  double least_range;
};
constexpr Panel kPanels[] = {{"F2 aligned", 0.05},
                             {"junction recall", 0.05},
                             {"junction precision", 0.05},
                             {"diameter error (mm)", 0.1},
                             {"CPU s per 30 frames", 0.5}};

std::string ChangesData(const std::vector<ChangeRow>& rows) {
  std::string data;
  for (const ChangeRow& row : rows) {
    data += '"' + row.name + '"';
    for (const Panel& panel : kPanels) {
      const auto& change = row.changes[HeadlineIndex(panel.figure)];
      data += change ? fmt::format(" {}", *change) : " ?";
    }
    data += "\n";
  }
  return data;
}

// Half the width of a panel.
double RangeOf(const Panel& panel, const std::vector<ChangeRow>& rows) {
  double range = panel.least_range;
  for (const ChangeRow& row : rows) {
    range = std::max(range, 1.05 * std::abs(row.changes[HeadlineIndex(panel.figure)].value_or(0)));
  }
  return range;
}

std::string ChangesCommands(const std::vector<ChangeRow>& rows, double label_width) {
  std::string commands = fmt::format(
      "set datafile missing '?'\nset style fill solid 0.85 noborder\nunset key\n"
      "set yrange [{}-0.4:-0.6]\nunset grid\n"
      "set grid xtics linecolor rgb '#DDDDDD' linewidth 0.6 dashtype 1\n"
      "set arrow 1 from 0,graph 0 to 0,graph 1 nohead linecolor rgb '#444444' linewidth 0.8\n"
      "set multiplot layout 1,{} margins {:.3f},0.985,{:.3f},{:.3f} spacing 0.025,0\n",
      rows.size(), std::size(kPanels), label_width, 0.25 / (1 + 0.14 * rows.size()),
      1 - 0.25 / (1 + 0.14 * rows.size()));
  int column = 2;
  for (const Panel& panel : kPanels) {
    const bool more_is_better = HeadlineFigures()[HeadlineIndex(panel.figure)].more_is_better;
    const double range = RangeOf(panel, rows);
    commands += fmt::format("set title '{}' offset 0,-0.6\nset xrange [-{}:{}]\nset xtics {:.1g}\n",
                            panel.figure, range, range, range / 2);
    const auto bars = [&](const char* condition, int line_type) {
      return fmt::format(
          "data using (0):(${0} {1} 0 ? $0 : NaN):(0):{0}:($0-0.36):($0+0.36) with boxxyerror "
          "linetype {2}",
          column, condition, line_type);
    };
    const std::string names =
        column == 2 ? "data using (0):0:ytic(1) with points pointsize 0, " : "";
    commands += fmt::format("plot {}{}, {}\n", names, bars(">", more_is_better ? 2 : 1),
                            bars("<", more_is_better ? 1 : 2));
    commands += "set format y ''\nunset ytics\n";
    ++column;
  }
  return commands + "unset multiplot";
}

}  // namespace

void DrawChanges(const std::filesystem::path& folder, const std::string& name,
                 const std::vector<ChangeRow>& rows) {
  constexpr double kWidth = 7;
  constexpr double kLetter = 0.062;  // inches, of the figure's font
  size_t longest = 0;
  for (const ChangeRow& row : rows) longest = std::max(longest, row.name.size());
  const double label_width =
      std::min(0.45, (0.15 + kLetter * static_cast<double>(longest)) / kWidth);
  DrawPlot(folder, name,
           {ChangesData(rows), ChangesCommands(rows, label_width), kWidth,
            1 + 0.14 * static_cast<double>(rows.size())});
}

}  // namespace curvefusion
