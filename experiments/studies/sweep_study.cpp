// Values of the user's choice for settings of the user's choice, on simulated scans.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>

#include "experiments/studies/change_chart.h"
#include "experiments/studies/gnuplot.h"
#include "experiments/studies/headline_figures.h"
#include "experiments/studies/studies.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr const char* kDefault = "default";

// "key=v1,v2" -> {"key=v1", "key=v2"}.
std::vector<std::string> ValuesOf(const std::string& assignment) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw Error(ErrorKind::kUsage, "--set " + assignment +
                                       ": write section.key=value,value,..., for example "
                                       "bundle.min_frames=1,2,3");
  }
  std::vector<std::string> values;
  std::istringstream stream(assignment.substr(equals + 1));
  for (std::string value; std::getline(stream, value, ',');) {
    values.push_back(assignment.substr(0, equals + 1) + value);
  }
  if (values.empty()) values.push_back(assignment);  // to be refused as any value that is none
  return values;
}

// Every combination of the values; the first is the profile as it is.
std::vector<std::vector<std::string>> Grid(const std::vector<std::string>& assignments) {
  std::vector<std::vector<std::string>> grid = {{}};
  for (const std::string& assignment : assignments) {
    std::vector<std::vector<std::string>> finer;
    for (const auto& setting : grid) {
      for (const std::string& value : ValuesOf(assignment)) {
        finer.push_back(setting);
        finer.back().push_back(value);
      }
    }
    grid = finer;
  }
  if (!assignments.empty()) grid.insert(grid.begin(), std::vector<std::string>{});
  return grid;
}

std::string NameOf(const std::vector<std::string>& setting) {
  return setting.empty() ? kDefault : fmt::format("{}", fmt::join(setting, " "));
}

std::vector<StudyCase> Cases(const StudyRequest& request) {
  const auto grid = Grid(request.assignments);
  const Profile profile = request.profiles.back();
  StudyRequest plain = request;
  plain.assignments.clear();
  std::vector<StudyCase> cases;
  for (const std::string& object : ObjectsOf(request)) {
    for (const uint64_t seed : SeedsOf(request)) {
      for (const auto& setting : grid) {
        cases.push_back({{{"object", object}, {"setting", NameOf(setting)}},
                         seed,
                         ObjectScan(request, object, seed),
                         CaseConfig(plain, profile, setting)});
      }
    }
  }
  return cases;
}

std::string RatioText(const std::optional<double>& value, const std::optional<double>& reference,
                      int decimals) {
  if (!value) return "-";
  const std::string number = fmt::format("{:.{}f}", *value, decimals);
  if (!reference || *reference == 0) return number;
  return fmt::format("{} ({:.2f})", number, *value / *reference);
}

// The number in "key=number" where all but the default are settings of one key; none otherwise.
std::optional<double> NumberOf(const std::string& setting) {
  const std::string text = setting.substr(setting.find('=') + 1);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') return std::nullopt;
  return value;
}

struct CurvePoint {
  double value;
  std::vector<std::optional<double>> figures;
};

// The points of the curves by value; none where the settings are not numbers of one key.
std::vector<CurvePoint> CurveOf(const std::vector<RunGroup>& groups) {
  std::vector<CurvePoint> curve;
  for (const RunGroup& group : groups) {
    const std::string setting = LabelOf(group.labels, "setting");
    if (setting == kDefault) continue;
    const std::optional<double> value = NumberOf(setting);
    if (!value) return {};
    curve.push_back({*value, HeadlineValues(group)});
  }
  std::sort(curve.begin(), curve.end(),
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

void Report(const StudyResults& results) {
  const std::vector<RunGroup> groups = GroupRuns(results.runs, {"setting"});
  const auto reference = HeadlineValues(groups.front());
  std::vector<ChangeRow> changes;
  for (const RunGroup& group : groups) {
    changes.push_back(
        {LabelOf(group.labels, "setting"), ChangesOf(reference, HeadlineValues(group))});
  }
  Table table = MedianTable(groups, {});
  AddHeadlineColumns(table, [&](size_t row, size_t figure) {
    return RatioText(HeadlineValues(groups[row])[figure], reference[figure],
                     HeadlineFigures()[figure].decimals);
  });
  WriteTable(results.folder, results.stem, table);
  DrawChanges(results.folder, results.stem, changes);
  const std::vector<CurvePoint> curve = CurveOf(groups);
  if (curve.size() < 2) return;
  const std::string setting = LabelOf(groups[1].labels, "setting");
  DrawPlot(results.folder, results.stem + "_curves",
           {CurveData(curve, reference), CurveCommands(setting.substr(0, setting.find('=')), curve),
            6.5, 4.2});
}

}  // namespace

Study SweepStudy() {
  return {"sweep", "Settings tried in all combinations: --set section.key=value,value,...",
          true,    Cases,
          {},      Report};
}

}  // namespace curvefusion
