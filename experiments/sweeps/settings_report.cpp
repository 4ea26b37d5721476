#include "experiments/sweeps/settings_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "experiments/studies/change_chart.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/headline_figures.h"
#include "experiments/studies/result_table.h"
#include "experiments/sweeps/sweep_cells.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

std::string RatioText(const std::optional<double>& value, const std::optional<double>& reference,
                      int decimals) {
  if (!value) return "-";
  const std::string number = fmt::format("{:.{}f}", *value, decimals);
  if (!reference || *reference == 0) return number;
  return fmt::format("{} ({:.2f})", number, *value / *reference);
}

// "section.key=3" in two.
struct SingleSetting {
  std::string key;
  double value = 0;
};

// None where a setting is no number, or there are several of them.
std::optional<SingleSetting> SingleSettingOf(const std::string& setting) {
  const size_t equals = setting.find('=');
  if (equals == std::string::npos) return std::nullopt;
  const auto value = ParseNumber(std::string_view(setting).substr(equals + 1));
  if (!value) return std::nullopt;
  return SingleSetting{setting.substr(0, equals), *value};
}

struct CurvePoint {
  double value;
  std::vector<std::optional<double>> figures;
};

// Figures over the values of one setting, by value; no points where other settings differ, too.
struct SettingCurve {
  std::string key;
  std::vector<CurvePoint> points;
};

SettingCurve CurveOf(const std::vector<RunGroup>& groups) {
  SettingCurve curve;
  for (const RunGroup& group : groups) {
    const std::string name = LabelOf(group.labels, "setting");
    if (name == kDefaultSetting) continue;
    const auto setting = SingleSettingOf(name);
    if (!setting || (!curve.key.empty() && setting->key != curve.key)) return {};
    curve.key = setting->key;
    curve.points.push_back({setting->value, HeadlineValues(group)});
  }
  std::sort(curve.points.begin(), curve.points.end(),
            [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; });
  return curve;
}

struct Curve {
  const char* figure;
  const char* title;
  int panel;
};
constexpr Curve kCurves[] = {{"F2 aligned", "F at 2 mm", 0},
                             {"F5 aligned", "F at 5 mm", 0},
                             {"junction recall", "junction recall", 1},
                             {"junction precision", "precision", 1},
                             {"diameter error (mm)", "diameter error (mm)", 2},
                             {"CPU s per 30 frames", "CPU s per 30 frames", 3}};
constexpr int kPanels = 4;

std::string Cell(const std::optional<double>& value) {
  return value ? fmt::format(" {}", *value) : " ?";
}

// Rows of a value, the figures of kCurves, then those of the default.
std::string CurveData(const std::vector<CurvePoint>& curve,
                      const std::vector<std::optional<double>>& reference) {
  std::string data;
  for (const CurvePoint& point : curve) {
    data += fmt::format("{}", point.value);
    for (const Curve& drawn : kCurves) data += Cell(point.figures[HeadlineIndex(drawn.figure)]);
    for (const Curve& drawn : kCurves) data += Cell(reference[HeadlineIndex(drawn.figure)]);
    data += "\n";
  }
  return data;
}

// Whether values lie so far apart that a linear axis would crowd the small ones.
bool IsSpreadWide(const std::vector<CurvePoint>& curve) {
  return curve.front().value > 0 && curve.back().value > 20 * curve.front().value;
}

// A little more than the values span; gnuplot finds no range of its own where no run has a figure.
std::string ValueAxis(const std::vector<CurvePoint>& curve) {
  const double first = curve.front().value;
  const double last = curve.back().value;
  if (IsSpreadWide(curve)) {
    return fmt::format("set logscale x\nset xrange [{}:{}]\n", first / 1.15, last * 1.15);
  }
  const double margin = 0.04 * (last - first);
  return fmt::format("set xrange [{}:{}]\n", first - margin, last + margin);
}

// The curves of a panel and lines for the default; none where no run has such figures.
std::vector<std::string> CurvesOf(int panel, const std::vector<CurvePoint>& curve) {
  const int count = static_cast<int>(std::size(kCurves));
  std::vector<std::string> parts;
  int line_type = 1;
  for (int i = 0; i < count; ++i) {
    const size_t figure = HeadlineIndex(kCurves[i].figure);
    const bool has_values = std::any_of(curve.begin(), curve.end(), [&](const CurvePoint& point) {
      return point.figures[figure].has_value();
    });
    if (kCurves[i].panel != panel || !has_values) continue;
    parts.push_back(fmt::format("data using 1:{} with linespoints linetype {} title '{}'", i + 2,
                                line_type, kCurves[i].title));
    parts.push_back(fmt::format("data using 1:{} with lines linetype {} linewidth 0.8 dashtype 2",
                                i + 2 + count, line_type));
    ++line_type;
  }
  return parts;
}

std::string CurveCommands(const std::string& key, const std::vector<CurvePoint>& curve) {
  std::vector<double> ticks;
  for (const CurvePoint& point : curve) ticks.push_back(point.value);
  std::string commands = fmt::format(
      "set datafile missing '?'\n{}set xtics ({})\nset xlabel '{} (dashed: default)' noenhanced "
      "offset 0,0.4\n"
      "set offsets 0,0,graph 0.08,0\n"
      "set multiplot layout 2,2 margins 0.075,0.985,0.11,0.93 spacing 0.10,0.22\n"
      "set key at graph 0.5,1.21 center top vertical samplen 2.5\n",
      ValueAxis(curve), fmt::join(ticks, ", "), key);
  for (int panel = 0; panel < kPanels; ++panel) {
    const std::vector<std::string> parts = CurvesOf(panel, curve);
    if (parts.empty()) continue;
    commands +=
        fmt::format("set yrange [{}:*]\nplot {}\n", panel < 2 ? "*" : "0", fmt::join(parts, ", "));
  }
  return commands + "unset multiplot";
}

// More rows than that are no picture any more: the table has them.
constexpr size_t kMostBars = 40;

}  // namespace

void ReportSettings(const StudyResults& results, bool draws) {
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"setting"});
  const auto standard = std::find_if(groups.begin(), groups.end(), [](const RunGroup& group) {
    return LabelOf(group.labels, "setting") == kDefaultSetting;
  });
  const auto reference =
      standard != groups.end() ? HeadlineValues(*standard) : HeadlineValues(RunGroup{});
  std::vector<ChangeRow> changes;
  std::vector<std::vector<std::optional<double>>> values;
  for (const RunGroup& group : groups) {
    values.push_back(HeadlineValues(group));
    changes.push_back({LabelOf(group.labels, "setting"), ChangesOf(reference, values.back())});
  }
  Table table = MedianTable(groups, {});
  AddHeadlineColumns(table, [&](size_t row, size_t figure) {
    return RatioText(values[row][figure], reference[figure], HeadlineFigures()[figure].decimals);
  });
  WriteTable(results.folder, results.stem, table);
  if (!draws || standard == groups.end() || groups.size() < 2) return;
  if (groups.size() <= kMostBars) DrawChanges(results.folder, results.stem, changes);
  const SettingCurve curve = CurveOf(groups);
  if (curve.points.size() < 2) return;
  DrawPlot(results.folder, results.stem + "_curves",
           {CurveData(curve.points, reference), CurveCommands(curve.key, curve.points), 6.5, 4.2});
}

}  // namespace curvefusion
