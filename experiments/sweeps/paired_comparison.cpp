#include "experiments/sweeps/paired_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "experiments/csv_cell.h"
#include "experiments/studies/headline_figures.h"
#include "kernel/atomic_file.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr int kDraws = 2000;  // Efron and Tibshirani 1993, 13.3: at least 1000 for such intervals

struct Pair {
  const CellResult* before;
  const CellResult* after;
};

using PairKey = std::tuple<std::string, Profile, std::string>;

bool IsMeasured(const CellResult& result) {
  return result.run.outcome != kMissing && result.run.outcome != "failed";
}

// By scan, so that a draw of scans is a draw of groups.
using PairsByScan = std::map<std::string, std::vector<Pair>>;

PairsByScan PairsOf(const std::vector<CellResult>& before, const std::vector<CellResult>& after,
                    const std::optional<std::string>& after_setting, int& unpaired) {
  std::map<PairKey, const CellResult*> partners;
  for (const CellResult& result : before) {
    const std::string setting = SettingName(result.cell);
    if (after_setting && setting != kDefaultSetting) continue;
    if (!IsMeasured(result)) ++unpaired;
    if (IsMeasured(result)) partners[{result.cell.scan, result.cell.profile, setting}] = &result;
  }
  PairsByScan pairs;
  for (const CellResult& result : after) {
    const std::string setting = SettingName(result.cell);
    if (after_setting && setting != *after_setting) continue;
    const std::string wanted = after_setting ? kDefaultSetting : setting;
    const auto partner = partners.find({result.cell.scan, result.cell.profile, wanted});
    if (partner == partners.end() || !IsMeasured(result)) {
      ++unpaired;
      continue;
    }
    pairs[result.cell.scan].push_back({partner->second, &result});
    partners.erase(partner);
  }
  unpaired += static_cast<int>(partners.size());
  return pairs;
}

std::optional<double> ValueOf(const CellResult& result, const HeadlineFigure& figure) {
  return HeadlineValue({result.run.labels, {&result.run}}, figure);
}

// The differences of a figure, scan by scan.
struct Differences {
  std::vector<std::vector<double>> by_scan;
  std::vector<double> before;
  std::vector<double> after;
};

double MedianOf(const Differences& differences, const std::vector<size_t>& scans) {
  std::vector<double> values;
  for (const size_t scan : scans) {
    const auto& more = differences.by_scan[scan];
    values.insert(values.end(), more.begin(), more.end());
  }
  return SpreadOf(std::move(values))->median;
}

void Judge(const Pair& pair, const HeadlineFigure& figure, double before, double after,
           double tolerance, FigureComparison& comparison, std::vector<WorseCell>& worse) {
  const double gain = figure.more_is_better ? after - before : before - after;
  const double limit = figure.is_cost ? tolerance * before : tolerance;
  comparison.better += gain > limit ? 1 : 0;
  if (gain >= -limit) return;
  ++comparison.worse;
  worse.push_back({figure.name, pair.before, pair.after, after - before});
}

std::optional<FigureComparison> CompareFigure(const PairsByScan& pairs,
                                              const HeadlineFigure& figure, double tolerance,
                                              std::vector<WorseCell>& worse) {
  FigureComparison comparison{figure.name};
  Differences differences;
  for (const auto& [scan, of_scan] : pairs) {
    std::vector<double> values;
    for (const Pair& pair : of_scan) {
      const auto before = ValueOf(*pair.before, figure);
      const auto after = ValueOf(*pair.after, figure);
      if (!before || !after) continue;
      values.push_back(*after - *before);
      differences.before.push_back(*before);
      differences.after.push_back(*after);
      Judge(pair, figure, *before, *after, tolerance, comparison, worse);
    }
    if (!values.empty()) differences.by_scan.push_back(values);
  }
  if (differences.by_scan.empty()) return std::nullopt;
  comparison.pairs = static_cast<int>(differences.before.size());
  comparison.before = SpreadOf(differences.before)->median;
  comparison.after = SpreadOf(differences.after)->median;
  std::vector<double> medians;
  for (const auto& scans : BootstrapDraws(differences.by_scan.size(), kDraws)) {
    medians.push_back(MedianOf(differences, scans));
  }
  comparison.interval = PercentileInterval(medians);
  std::vector<size_t> all(differences.by_scan.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = i;
  comparison.difference = MedianOf(differences, all);
  return comparison;
}

}  // namespace

Interval PercentileInterval(std::vector<double> values) {
  const double low = Quantile(values, 0.025);
  return {low, Quantile(std::move(values), 0.975)};
}

std::vector<std::vector<size_t>> BootstrapDraws(size_t count, int draws) {
  std::mt19937_64 random(1);
  std::vector<std::vector<size_t>> result(draws, std::vector<size_t>(count));
  for (auto& draw : result) {
    for (size_t& i : draw) i = random() % count;
  }
  return result;
}

SweepComparison CompareSweeps(const std::vector<CellResult>& before,
                              const std::vector<CellResult>& after, double tolerance,
                              const std::optional<std::string>& after_setting) {
  SweepComparison comparison;
  const PairsByScan pairs = PairsOf(before, after, after_setting, comparison.unpaired);
  for (const HeadlineFigure& figure : HeadlineFigures()) {
    std::vector<WorseCell> worse;
    const auto compared = CompareFigure(pairs, figure, tolerance, worse);
    if (!compared) continue;
    comparison.figures.push_back(*compared);
    std::stable_sort(worse.begin(), worse.end(), [](const WorseCell& a, const WorseCell& b) {
      return std::abs(a.difference) > std::abs(b.difference);
    });
    comparison.worse.insert(comparison.worse.end(), worse.begin(), worse.end());
  }
  return comparison;
}

Table ComparisonTable(const SweepComparison& comparison) {
  Table table{
      {"figure", "pairs", "before", "after", "median difference", "95 %", "better", "worse"},
      {},
      1};
  for (const FigureComparison& f : comparison.figures) {
    const auto number = [](double value) { return fmt::format("{:.4f}", value); };
    const auto change = [](double value) { return fmt::format("{:+.4f}", value); };
    table.rows.push_back({f.figure, std::to_string(f.pairs), number(f.before), number(f.after),
                          change(f.difference),
                          fmt::format("[{}, {}]", change(f.interval.low), change(f.interval.high)),
                          std::to_string(f.better), std::to_string(f.worse)});
  }
  return table;
}

std::string WorseCellText(const WorseCell& worse) {
  const SweepCell& cell = worse.after->cell;
  return fmt::format("worse: {} {:+.4f}: {}, seed {}, {}, {} ({})\n", worse.figure,
                     worse.difference, cell.object, cell.seed, ProfileName(cell.profile),
                     SettingName(cell), cell.key);
}

void WriteWorseCells(const std::filesystem::path& path, const SweepComparison& comparison) {
  WriteStreamAtomically(path, [&](std::ostream& stream) {
    stream << "figure,difference,object,seed,profile,setting,scan,before,after\n";
    for (const WorseCell& worse : comparison.worse) {
      const SweepCell& cell = worse.after->cell;
      stream << fmt::format("{},{},{},{},{},{},{},{},{}\n", worse.figure, worse.difference,
                            cell.object, cell.seed, ProfileName(cell.profile),
                            CsvCell(SettingName(cell)), cell.scan, worse.before->cell.key,
                            cell.key);
    }
  });
}

}  // namespace curvefusion
