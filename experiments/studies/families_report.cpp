#include "experiments/studies/families_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "experiments/studies/gnuplot.h"
#include "experiments/studies/result_table.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr size_t kWorst = 6;
constexpr const char* kMainFigure = "aligned.curves.2mm.f";
constexpr const char* kFalseLength = "aligned.curves.false_length";
constexpr const char* kDoubted = "doubted";

struct FamilyColumn {
  std::string heading;
  std::string figure;
  int decimals = 2;
  bool more_is_better = true;
};

const std::vector<FamilyColumn>& Columns() {
  static const std::vector<FamilyColumn> columns = {
      {"F1", "aligned.curves.1mm.f"},
      {"F2", kMainFigure},
      {"F5", "aligned.curves.5mm.f"},
      {"junction recall", "aligned.junctions_10mm.recall"},
      {"junction precision", "aligned.junctions_10mm.precision"},
      {"cycles exact", "cycles_exact"},
      {"tips found", "aligned.tips_5mm.recall"},
      {"tips true", "aligned.tips_5mm.precision"},
      {"false length (m)", kFalseLength, 2, false},
      {"diameter error (mm)", "raw.diameter.mean_error_mm", 2, false},
      {"s", "seconds", 0, false}};
  return columns;
}

std::string Cell(const RunGroup& group, const FamilyColumn& column) {
  std::vector<double> values;
  for (const StudyRun* run : group.runs) {
    const auto found = run->figures.find(column.figure);
    if (found != run->figures.end()) values.push_back(found->second);
  }
  const std::optional<Summary> summary = SummaryOf(values, column.more_is_better);
  if (!summary) return "-";
  return fmt::format("{:.{}f} / {:.{}f} / {:.{}f}", summary->median, column.decimals, summary->mean,
                     column.decimals, summary->worst_tenth, column.decimals);
}

// The labels and number of runs of MedianTable, with other cells.
Table SummaryTable(const std::vector<RunGroup>& groups) {
  Table table = MedianTable(groups, {});
  for (const FamilyColumn& column : Columns()) {
    table.headings.push_back(column.heading);
    for (size_t row = 0; row < groups.size(); ++row) {
      table.rows[row].push_back(Cell(groups[row], column));
    }
  }
  return table;
}

// Runs on simulated wires: all but rooms and recordings.
std::vector<StudyRun> WithWires(const std::vector<StudyRun>& runs) {
  std::vector<StudyRun> with_wires;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(with_wires), [](const StudyRun& run) {
    const std::string contrast = LabelOf(run.labels, "contrast");
    return contrast != "none" && contrast != "recording";
  });
  return with_wires;
}

double FigureOf(const StudyRun& run, const char* name) {
  const auto found = run.figures.find(name);
  return found == run.figures.end() ? 0 : found->second;
}

std::vector<StudyRun> WorstRuns(std::vector<StudyRun> runs) {
  std::erase_if(runs, [](const StudyRun& run) { return !run.figures.contains(kMainFigure); });
  std::stable_sort(runs.begin(), runs.end(), [](const StudyRun& a, const StudyRun& b) {
    return FigureOf(a, kMainFigure) < FigureOf(b, kMainFigure);
  });
  runs.resize(std::min(runs.size(), kWorst));
  return runs;
}

Table WorstTable(const std::vector<StudyRun>& worst) {
  Table table{{"family", "seed", "contrast", "sensor", "profile", "F2", "F5", "length (m)",
               "true length (m)", "false length (m)", "doubted"},
              {},
              5};
  for (const StudyRun& run : worst) {
    table.rows.push_back({LabelOf(run.labels, "family"), std::to_string(run.seed),
                          LabelOf(run.labels, "contrast"), LabelOf(run.labels, "sensor"),
                          LabelOf(run.labels, "profile"),
                          fmt::format("{:.2f}", FigureOf(run, kMainFigure)),
                          fmt::format("{:.2f}", FigureOf(run, "aligned.curves.5mm.f")),
                          fmt::format("{:.2f}", FigureOf(run, "length")),
                          fmt::format("{:.2f}", FigureOf(run, "true_length")),
                          fmt::format("{:.2f}", FigureOf(run, kFalseLength)),
                          FigureOf(run, kDoubted) > 0 ? "yes" : "no"});
  }
  return table;
}

void DrawWorst(const StudyResults& results, const std::vector<StudyRun>& worst) {
  if (worst.empty()) return;
  PictureGrid grid;
  grid.cell_width = 1.4;  // "umbrella 101, F2 0.92" fits
  grid.rows = {"truth", "result"};
  for (const StudyRun& run : worst) {
    grid.columns.push_back(fmt::format("{} {}, F2 {:.2f}", LabelOf(run.labels, "family"), run.seed,
                                       FigureOf(run, kMainFigure)));
  }
  for (const char* picture : {"truth.png", "result.png"}) {
    for (const StudyRun& run : worst) {
      const bool drawn = fs::exists(run.folder / picture);
      grid.pictures.push_back(drawn ? fs::relative(run.folder / picture, results.folder).string()
                                    : "");
    }
  }
  DrawPictureGrid(results.folder, results.stem + "_worst", grid);
}

// A block a profile: place of the family, F at 2 mm, false length.
std::string PlotData(const std::vector<RunGroup>& profiles,
                     const std::vector<std::string>& families) {
  std::string data;
  for (const RunGroup& profile : profiles) {
    data += "# " + profile.labels.front().second + "\n";
    for (const StudyRun* run : profile.runs) {
      const std::string family = LabelOf(run->labels, "family");
      const auto place = std::find(families.begin(), families.end(), family) - families.begin();
      const auto value = [&](const char* name) {
        return run->figures.contains(name) ? fmt::format("{}", run->figures.at(name)) : "?";
      };
      data += fmt::format("{} {} {}\n", place, value(kMainFigure), value(kFalseLength));
    }
    data += "\n\n";
  }
  return data;
}

std::string PlotCommands(const std::vector<RunGroup>& profiles,
                         const std::vector<std::string>& families, double greatest_false_length) {
  std::vector<std::string> tics;
  for (size_t i = 0; i < families.size(); ++i) {
    tics.push_back(fmt::format("'{}' {}", families[i], i));
  }
  std::string commands = fmt::format(
      "set datafile missing '?'\nset xrange [-0.6:{:.1f}]\n"
      "set xtics rotate by 40 right scale 0 ({})\n"
      "set multiplot layout 2,1 margins 0.07,0.99,0.14,0.95 spacing 0,0.2\n",
      static_cast<double>(families.size()) - 0.4, fmt::join(tics, ", "));
  const auto panel = [&](const char* title, int column) {
    // Of runs that have all failed gnuplot would draw nothing, and say so as an error.
    std::vector<std::string> parts = {"data index 0 using 1:(0) with points pointsize 0 notitle"};
    for (size_t i = 0; i < profiles.size(); ++i) {
      const double shift = (static_cast<double>(i) - (profiles.size() - 1) / 2.) * 0.3;
      parts.push_back(fmt::format(
          "data index {} using ($1{:+}):{} with points pointtype 7 pointsize 0.6 lt {} title '{}'",
          i, shift, column, i + 1, profiles[i].labels.front().second));
    }
    commands += fmt::format("set title '{}' offset 0,-0.6\nplot {}\nunset key\n", title,
                            fmt::join(parts, ", "));
  };
  commands += "set yrange [0:1.05]\n";
  panel("F at 2 mm, aligned", 2);
  commands += fmt::format("set yrange [0:{}]\n", 1.05 * greatest_false_length);
  panel("False length (m)", 3);
  return commands + "unset multiplot";
}

}  // namespace

std::optional<Summary> SummaryOf(std::vector<double> values, bool more_is_better) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  Summary summary;
  summary.median = SpreadOf(values)->median;
  summary.mean =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  if (!more_is_better) std::reverse(values.begin(), values.end());
  const auto worst = static_cast<std::ptrdiff_t>((values.size() + 9) / 10);
  summary.worst_tenth =
      std::accumulate(values.begin(), values.begin() + worst, 0.0) / static_cast<double>(worst);
  return summary;
}

Table TrustTable(const std::vector<StudyRun>& runs) {
  struct Class {
    const char* name;
    const char* figure;
    double least, most;
  };
  static constexpr Class kClasses[] = {
      {"F5 .95 and more", "aligned.curves.5mm.f", 0.95, 2},
      {"F5 .8 to .95", "aligned.curves.5mm.f", 0.8, 0.95},
      {"F5 .5 to .8", "aligned.curves.5mm.f", 0.5, 0.8},
      {"F5 below .5", "aligned.curves.5mm.f", 0, 0.5},
      {"a tenth of the curves or more false", "aligned.curves.5mm.precision", 0, 0.9}};
  Table table{{"results", "runs", "said not to be trusted"}, {}};
  for (const Class& of : kClasses) {
    int count = 0, doubted = 0;
    for (const StudyRun& run : runs) {
      const auto figure = run.figures.find(of.figure);
      if (figure == run.figures.end() || !run.figures.contains(kDoubted)) continue;
      if (figure->second < of.least || figure->second >= of.most) continue;
      ++count;
      doubted += FigureOf(run, kDoubted) > 0;
    }
    table.rows.push_back({of.name, std::to_string(count), std::to_string(doubted)});
  }
  return table;
}

void ReportFamilies(const StudyResults& results) {
  const std::vector<StudyRun> wires = WithWires(results.runs);
  const auto write = [&](const std::vector<StudyRun>& runs, const std::vector<std::string>& labels,
                         const std::string& name) {
    WriteTable(results.folder, results.stem + name, SummaryTable(GroupRuns(runs, labels)));
  };
  write(results.runs, {"profile", "family"}, "");
  write(wires, {"profile", "contrast"}, "_contrast");
  write(wires, {"profile", "sensor"}, "_sensor");
  write(wires, {"profile"}, "_all");
  const std::vector<StudyRun> worst = WorstRuns(wires);
  WriteTable(results.folder, results.stem + "_worst", WorstTable(worst));
  WriteTable(results.folder, results.stem + "_trust", TrustTable(wires));
  DrawWorst(results, worst);
  const std::vector<RunGroup> profiles = GroupRuns(results.runs, {"profile"});
  std::vector<std::string> families;
  for (const RunGroup& group : GroupRuns(results.runs, {"family"})) {
    families.push_back(group.labels.front().second);
  }
  DrawPlot(results.folder, results.stem,
           {PlotData(profiles, families),
            PlotCommands(profiles, families, GreatestOf(results.runs, kFalseLength, 0.1)), 7, 5});
}

}  // namespace curvefusion
