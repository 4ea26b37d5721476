#include "experiments/studies/change_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "experiments/studies/gnuplot.h"
#include "experiments/studies/headline_figures.h"

namespace curvefusion {

namespace {

// A headline figure that is drawn. A panel shows at least `least_range` to both sides: smaller
// changes are not blown up.
struct Panel {
  const char* figure;
  const char* title;
  double least_range;
};
constexpr Panel kPanels[] = {{"F2 aligned", "F at 2 mm,\\naligned", 0.05},
                             {"false length (m)", "False\\nlength, m", 0.05},
                             {"junction recall", "Junction\\nrecall", 0.05},
                             {"junction precision", "Junction\\nprecision", 0.05},
                             {"diameter error (mm)", "Diameter\\nerror, mm", 0.1},
                             {"CPU s per 30 frames", "CPU s,\\n30 frames", 0.5}};
constexpr double kRowHeight = 0.14;     // inches
constexpr double kTitleAndTicks = 0.6;  // inches

// Rows of a number, a name and the changes.
std::string ChangesData(const std::vector<ChangeRow>& rows) {
  std::string data;
  for (size_t i = 0; i < rows.size(); ++i) {
    data += fmt::format("{} \"{}\"", i, rows[i].name);
    for (const Panel& panel : kPanels) {
      const auto& change = rows[i].changes[HeadlineIndex(panel.figure)];
      data += change ? fmt::format(" {}", *change) : " ?";
    }
    data += "\n";
  }
  return data;
}

// Half the width of a panel. One or two changes far beyond the others do not set it, or nothing
// would be seen of those.
double RangeOf(const Panel& panel, const std::vector<ChangeRow>& rows) {
  std::vector<double> sizes = {0, 0, 0};
  for (const ChangeRow& row : rows) {
    sizes.push_back(std::abs(row.changes[HeadlineIndex(panel.figure)].value_or(0)));
  }
  std::sort(sizes.rbegin(), sizes.rend());
  const double range = rows.size() < 5 ? sizes[0] : std::min(sizes[0], 1.5 * sizes[2]);
  return std::max(panel.least_range, 1.05 * range);
}

// 1, 2 or 5 times a power of ten: the greatest below `range`.
double TickBelow(double range) {
  const double power = std::pow(10, std::floor(std::log10(range)));
  for (const double factor : {5, 2}) {
    if (factor * power < range) return factor * power;
  }
  return power;
}

// Bars to the better and to the worse, cut off where the panel ends. gnuplot dies of some plots
// without points, so that a row without a bar to one side has one of no length.
std::string BarsOf(const Panel& panel, int column, double range) {
  const bool more_is_better = HeadlineFigures()[HeadlineIndex(panel.figure)].more_is_better;
  const auto bars = [&](const std::string& end, int line_type) {
    return fmt::format("data using (0):1:(0):({}):($1-0.36):($1+0.36) with boxxyerror linetype {}",
                       end, line_type);
  };
  const std::string to_right = fmt::format("${0} > {1} ? {1} : ${0} > 0 ? ${0} : 0", column, range);
  const std::string to_left =
      fmt::format("${0} < -{1} ? -{1} : ${0} < 0 ? ${0} : 0", column, range);
  return bars(to_right, more_is_better ? 2 : 1) + ", " + bars(to_left, more_is_better ? 1 : 2);
}

// The values of bars that are cut off, written into them. gnuplot dies of labels without points:
// empty where no bar is.
std::string CutValuesOf(const Panel& panel, int column, double range,
                        const std::vector<ChangeRow>& rows) {
  const auto is_cut = [&](const ChangeRow& row) {
    return std::abs(row.changes[HeadlineIndex(panel.figure)].value_or(0)) > range;
  };
  if (std::none_of(rows.begin(), rows.end(), is_cut)) return "";
  return fmt::format(
      ", data using (abs(${0}) > {1} ? sgn(${0})*0.7*{1} : NaN):1:(sprintf('%.2f',${0})) with "
      "labels font ',6' textcolor rgb 'white'",
      column, range);
}

std::string ChangesCommands(const std::vector<ChangeRow>& rows, double label_width, double height) {
  std::string commands = fmt::format(
      "set datafile missing '?'\nset style fill solid 0.85 noborder\nunset key\n"
      "set yrange [{}-0.4:-0.6]\nset ytics noenhanced scale 0\nunset grid\n"
      "set grid xtics linecolor rgb '#DDDDDD' linewidth 0.6 dashtype 1\n"
      "set arrow 1 from 0,graph 0 to 0,graph 1 nohead linecolor rgb '#444444' linewidth 0.8\n"
      "set multiplot layout 1,{} margins {:.3f},0.985,{:.3f},{:.3f} spacing 0.02,0\n",
      rows.size(), std::size(kPanels), label_width, 0.25 / height, 1 - 0.35 / height);
  int column = 3;
  for (const Panel& panel : kPanels) {
    const double range = RangeOf(panel, rows);
    const bool first = column == 3;
    commands += fmt::format(
        "set title \"{0}\" offset 0,-0.6\nset xrange [-{1}:{1}]\nset xtics (-{2}, 0, {2}) font "
        "',6'\n"
        "plot {3}{4}{5}\nunset ytics\n",
        panel.title, range, TickBelow(0.8 * range),
        first ? "data using (0):1:ytic(2) with points pointsize 0, " : "",
        BarsOf(panel, column, range), CutValuesOf(panel, column, range, rows));
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
  const double height = kTitleAndTicks + kRowHeight * static_cast<double>(rows.size());
  DrawPlot(folder, name,
           {ChangesData(rows), ChangesCommands(rows, label_width, height), kWidth, height});
}

}  // namespace curvefusion
