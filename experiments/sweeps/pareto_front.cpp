#include "experiments/sweeps/pareto_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "experiments/csv_cell.h"
#include "experiments/studies/gnuplot.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr int kDraws = 1000;  // as PercentileInterval needs

const HeadlineFigure& TimeFigure() {
  return HeadlineFigures()[HeadlineIndex("CPU s per 30 frames")];
}

struct Values {
  double figure = 0;
  double seconds = 0;
};

// A point's runs, one a scan, in the order of the scans.
struct Candidate {
  Profile profile;
  std::string setting;
  std::vector<const StudyRun*> runs;
};

bool IsComplete(const Candidate& candidate) {
  return std::none_of(candidate.runs.begin(), candidate.runs.end(), [](const StudyRun* run) {
    return run == nullptr || run->outcome == kMissing || run->outcome == "failed";
  });
}

std::vector<Candidate> CandidatesOf(const std::vector<CellResult>& results, size_t& scan_count) {
  std::map<std::string, size_t> scans;
  for (const CellResult& result : results) scans.emplace(result.cell.scan, scans.size());
  scan_count = scans.size();
  std::vector<Candidate> candidates;
  std::map<std::pair<Profile, std::string>, size_t> index;
  for (const CellResult& result : results) {
    const std::string setting = SettingName(result.cell);
    const auto [place, is_new] =
        index.try_emplace({result.cell.profile, setting}, candidates.size());
    if (is_new) {
      candidates.push_back(
          {result.cell.profile, setting, std::vector<const StudyRun*>(scans.size(), nullptr)});
    }
    candidates[place->second].runs[scans.at(result.cell.scan)] = &result.run;
  }
  return candidates;
}

// A draw in which a figure has no value counts as the worst there is.
Values ValuesOf(const Candidate& candidate, const std::vector<size_t>& scans,
                const HeadlineFigure& figure) {
  RunGroup group;
  for (const size_t scan : scans) group.runs.push_back(candidate.runs[scan]);
  const double worst = figure.more_is_better ? 0 : std::numeric_limits<double>::max();
  return {HeadlineValue(group, figure).value_or(worst),
          HeadlineValue(group, TimeFigure()).value_or(std::numeric_limits<double>::max())};
}

// Which points no other one beats: sorted by time, those that are better than all before.
std::vector<bool> FrontOf(const std::vector<Values>& values, bool more_is_better) {
  const double sign = more_is_better ? 1 : -1;
  std::vector<size_t> order(values.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    if (values[a].seconds != values[b].seconds) return values[a].seconds < values[b].seconds;
    return sign * values[a].figure > sign * values[b].figure;
  });
  std::vector<bool> front(values.size(), false);
  const Values* last = nullptr;  // of the front
  for (const size_t i : order) {
    const bool equal =
        last != nullptr && last->seconds == values[i].seconds && last->figure == values[i].figure;
    if (last != nullptr && !equal && !(sign * values[i].figure > sign * last->figure)) continue;
    front[i] = true;
    last = &values[i];
  }
  return front;
}

void Resample(const std::vector<Candidate>& candidates, size_t scan_count,
              const HeadlineFigure& figure, std::vector<ParetoPoint>& points) {
  std::vector<std::vector<double>> figures(points.size());
  std::vector<std::vector<double>> seconds(points.size());
  for (const auto& scans : BootstrapDraws(scan_count, kDraws)) {
    std::vector<Values> values;
    for (const Candidate& candidate : candidates) {
      values.push_back(ValuesOf(candidate, scans, figure));
    }
    const std::vector<bool> front = FrontOf(values, figure.more_is_better);
    for (size_t i = 0; i < points.size(); ++i) {
      figures[i].push_back(values[i].figure);
      seconds[i].push_back(values[i].seconds);
      points[i].front_probability += front[i] ? 1.0 / kDraws : 0;
    }
  }
  for (size_t i = 0; i < points.size(); ++i) {
    points[i].figure_interval = PercentileInterval(figures[i]);
    points[i].seconds_interval = PercentileInterval(seconds[i]);
  }
}

std::string IntervalText(double value, const Interval& interval, int decimals) {
  return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", value, decimals, interval.low, decimals,
                     interval.high, decimals);
}

void Draw(const std::filesystem::path& folder, const ParetoFront& front,
          const HeadlineFigure& figure) {
  std::vector<ParetoPoint> points = front.points;
  std::sort(points.begin(), points.end(), [](const ParetoPoint& a, const ParetoPoint& b) {
    return std::pair(a.seconds, a.figure) < std::pair(b.seconds, b.figure);
  });
  const auto rows = [&](bool only_front) {
    std::string text;
    for (const ParetoPoint& p : points) {
      if (only_front && !p.on_front) continue;
      text += fmt::format("{} {} {} {} {} {}\n", p.seconds, p.figure, p.seconds_interval.low,
                          p.seconds_interval.high, p.figure_interval.low, p.figure_interval.high);
    }
    return text;
  };
  const std::string commands = fmt::format(
      "set xlabel '{}'\nset ylabel '{}'\nset key bottom right\n"
      "plot data index 0 using 1:2:3:4:5:6 with xyerrorbars linetype 2 title 'settings, 95 %', "
      "data index 1 using 1:2 with linespoints linetype 1 title 'front'",
      TimeFigure().name, figure.name);
  DrawPlot(folder, "pareto", {rows(false) + "\n\n" + rows(true), commands, 5, 3.4});
}

}  // namespace

const HeadlineFigure& AccuracyFigure(const std::string& name) {
  std::vector<std::string> names;
  for (const HeadlineFigure& figure : HeadlineFigures()) {
    if (figure.is_cost) continue;
    if (figure.name == name) return figure;
    names.push_back(figure.name);
  }
  throw Error(ErrorKind::kUsage, "there is no figure " + name + "; did you mean \"" +
                                     NearestName(name, names) + "\"?");
}

ParetoFront FindParetoFront(const std::vector<CellResult>& results, const HeadlineFigure& figure) {
  size_t scan_count = 0;
  std::vector<Candidate> candidates = CandidatesOf(results, scan_count);
  ParetoFront front;
  front.scans = static_cast<int>(scan_count);
  std::erase_if(candidates, [&](const Candidate& candidate) {
    if (IsComplete(candidate)) return false;
    front.left_out.push_back(ProfileName(candidate.profile) + " " + candidate.setting);
    return true;
  });
  if (candidates.empty()) {
    throw Error(ErrorKind::kBadInput,
                "no setting was measured on every scan yet; finish the sweep first");
  }
  std::vector<size_t> all(scan_count);
  for (size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<Values> values;
  for (const Candidate& candidate : candidates) {
    values.push_back(ValuesOf(candidate, all, figure));
    front.points.push_back(
        {candidate.profile, candidate.setting, values.back().figure, values.back().seconds});
  }
  const std::vector<bool> on_front = FrontOf(values, figure.more_is_better);
  for (size_t i = 0; i < on_front.size(); ++i) front.points[i].on_front = on_front[i];
  Resample(candidates, scan_count, figure, front.points);
  const double sign = figure.more_is_better ? 1 : -1;
  std::stable_sort(front.points.begin(), front.points.end(),
                   [&](const ParetoPoint& a, const ParetoPoint& b) {
                     return sign * a.figure > sign * b.figure;
                   });
  return front;
}

Table ParetoTable(const ParetoFront& front, const HeadlineFigure& figure) {
  Table table{
      {"profile", "setting", figure.name, TimeFigure().name, "front", "probability"}, {}, 2};
  for (const ParetoPoint& p : front.points) {
    table.rows.push_back({ProfileName(p.profile), p.setting,
                          IntervalText(p.figure, p.figure_interval, figure.decimals),
                          IntervalText(p.seconds, p.seconds_interval, TimeFigure().decimals),
                          p.on_front ? "yes" : "", fmt::format("{:.2f}", p.front_probability)});
  }
  return table;
}

void WriteParetoFront(const std::filesystem::path& folder, const ParetoFront& front,
                      const HeadlineFigure& figure) {
  WriteTable(folder, "pareto", ParetoTable(front, figure));
  WriteStreamAtomically(folder / "pareto.csv", [&](std::ostream& stream) {
    stream << "profile,setting,figure,figure_low,figure_high,seconds,seconds_low,seconds_high,"
              "on_front,front_probability\n";
    for (const ParetoPoint& p : front.points) {
      stream << fmt::format("{},{},{},{},{},{},{},{},{:d},{:.3f}\n", ProfileName(p.profile),
                            CsvCell(p.setting), p.figure, p.figure_interval.low,
                            p.figure_interval.high, p.seconds, p.seconds_interval.low,
                            p.seconds_interval.high, p.on_front, p.front_probability);
    }
  });
  Draw(folder, front, figure);
}

}  // namespace curvefusion
