#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/studies/result_table.h"
#include "experiments/sweeps/sweep_results.h"

namespace curvefusion {

/// An interval that a resampling gives.
struct Interval {
  double low = 0;
  double high = 0;
};

/// The least and greatest of all but 5 % of the values (percentile interval, Efron and Tibshirani
/// 1993, 13.3). Values must not be empty.
Interval PercentileInterval(std::vector<double> values);

/// Draws of `count` numbers below `count`, with replacement: which scans a resampled study has. The
/// same for the same arguments on any machine.
std::vector<std::vector<size_t>> BootstrapDraws(size_t count, int draws);

/// How a headline figure differs between two sweeps.
struct FigureComparison {
  std::string figure;
  int pairs = 0;
  double before = 0;  ///< median over pairs
  double after = 0;
  double difference = 0;  ///< median of after minus before
  Interval interval;      ///< of that median, 95 %
  int better = 0;         ///< pairs beyond the tolerance
  int worse = 0;
};

/// A pair that is worse by more than the tolerance.
struct WorseCell {
  std::string figure;
  const CellResult* before = nullptr;  ///< point into the results that were compared
  const CellResult* after = nullptr;
  double difference = 0;
};

struct SweepComparison {
  std::vector<FigureComparison> figures;
  std::vector<WorseCell> worse;  ///< by figure, the worst first
  int unpaired = 0;              ///< cells of either without a partner that was measured
};

/// Pairs the cells of two sweeps that have scan, profile and setting in common (whatever program
/// measured them). Where `after_setting` is given, it is that setting of `after` against the
/// default of `before`. Intervals resample scans, not cells: those of one scan are not independent.
/// `tolerance` is in the unit of the figure, of costs a share of what they were before; a result
/// without curves counts with F = 0, a failed one is unpaired.
SweepComparison CompareSweeps(const std::vector<CellResult>& before,
                              const std::vector<CellResult>& after, double tolerance,
                              const std::optional<std::string>& after_setting = {});

/// A row a figure.
Table ComparisonTable(const SweepComparison& comparison);

/// "worse: F2 aligned -0.0310: cage, seed 2, best, default (KEY)" and a line end.
std::string WorseCellText(const WorseCell& worse);

/// Writes all pairs that are worse as CSV.
void WriteWorseCells(const std::filesystem::path& path, const SweepComparison& comparison);

}  // namespace curvefusion
