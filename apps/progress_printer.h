#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "apps/run_estimate.h"

namespace curvefusion {

/// Shows how far a run is. On a terminal one line that is overwritten; otherwise a line when a
/// stage is done and every ten seconds in between; or nothing. With a plan, the time left is that
/// of the whole run, otherwise that of the stage.
class ProgressPrinter {
 public:
  enum class Style { kQuiet, kLines, kTerminal };
  using Clock = std::function<double()>;  ///< seconds since any moment

  ProgressPrinter(std::ostream& stream, Style style, Clock clock);

  /// All stages of a run and their expected costs; may be told again when they are better known.
  void Plan(const std::vector<PlannedStage>& stages);

  /// A stage is `done` of `total` steps far. A new stage name, or fewer steps done than before,
  /// begins a new stage and ends the one before.
  void Report(const std::string& stage, int64_t done, int64_t total);

  /// Ends the line of the last stage, so that other output can follow.
  void Finish();

 private:
  void BeginStage(const std::string& stage, double start);
  std::string Line() const;
  std::string TimeLeft() const;
  std::string RunLine() const;

  std::ostream& stream_;
  Style style_;
  Clock clock_;
  bool is_planned_ = false;
  RunEstimate run_;
  double run_start_;
  std::string stage_;
  int64_t done_ = 0;
  int64_t total_ = 0;
  double stage_start_ = 0;
  double last_report_;
  double last_print_ = 0;
};

/// A printer to standard error in the style that fits it.
ProgressPrinter MakeProgressPrinter(bool quiet);

}  // namespace curvefusion
