#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/studies/headline_figures.h"
#include "experiments/sweeps/paired_comparison.h"

namespace curvefusion {

/// A profile and setting with what it reaches and costs over all scans.
struct ParetoPoint {
  Profile profile = Profile::kBest;
  std::string setting;
  double figure = 0;         ///< the headline figure that was asked for
  double seconds = 0;        ///< of the processor for 30 frames
  Interval figure_interval;  ///< 95 %, over draws of scans
  Interval seconds_interval;
  bool on_front = false;         ///< no other point is better in one and as good in the other
  double front_probability = 0;  ///< share of the draws in which it is
};

struct ParetoFront {
  std::vector<ParetoPoint> points;    ///< the best figure first
  std::vector<std::string> left_out;  ///< "PROFILE SETTING" of those not measured on every scan
  int scans = 0;
};

/// The headline figure of that name. Throws Error(kUsage) naming the nearest one; costs are none.
const HeadlineFigure& AccuracyFigure(const std::string& name);

/// Which settings one may choose: more of the figure costs more time. All points are measured on
/// the same draws of scans, so that what scans have in common does not blur the comparison.
/// O(points x draws x scans). Throws Error(kBadInput) where no point was measured on every scan.
ParetoFront FindParetoFront(const std::vector<CellResult>& results, const HeadlineFigure& figure);

/// A row a point.
Table ParetoTable(const ParetoFront& front, const HeadlineFigure& figure);

/// Writes pareto.csv, pareto.md and pareto.tex, and draws pareto.png and .pdf.
void WriteParetoFront(const std::filesystem::path& folder, const ParetoFront& front,
                      const HeadlineFigure& figure);

}  // namespace curvefusion
