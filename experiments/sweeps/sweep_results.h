#pragma once

#include <string>
#include <vector>

#include "experiments/studies/study.h"
#include "experiments/sweeps/sweep_plan.h"

namespace curvefusion {

/// How a cell stands that has no result.
inline constexpr const char* kMissing = "missing";

/// A cell and what was measured.
struct CellResult {
  SweepCell cell;
  StudyRun run;  ///< with the labels "object", "profile", "setting"; `outcome` may be kMissing
};

/// All cells of a sweep in their order, with the results that there are.
std::vector<CellResult> ReadCellResults(const SweepPlan& plan);

/// How far a sweep is.
struct SweepStatus {
  int cells = 0;
  int done = 0;
  int nothing_found = 0;
  int failed = 0;
  int missing = 0;
  int scans = 0;                      ///< that the cells need
  int missing_scans = 0;              ///< not simulated yet
  std::vector<std::string> failures;  ///< "KEY (object, seed, profile, setting): message"
};
SweepStatus StatusOf(const SweepPlan& plan, const std::vector<CellResult>& results);

/// Writes into the sweep's folder:
/// table.csv, a row a cell with what it is, its outcome and every figure that does not depend on
/// the machine: the same bytes wherever and in whatever order cells were measured;
/// costs.csv, a row a measured cell with seconds, memory, program and place of its result;
/// for each profile a table of headline figures by setting (settings_PROFILE.md, .tex) and, where
/// gnuplot can be run, bars of the changes and curves over the values of a single setting. Does
/// nothing where table.csv is as it would be, unless it is to be made `anew`. Returns why there are
/// no figures, empty where there are or where nothing can be drawn.
std::string CollectSweep(const SweepPlan& plan, const std::vector<CellResult>& results, bool anew);

}  // namespace curvefusion
