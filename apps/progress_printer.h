#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>

namespace curvefusion {

/// Shows how far a run is. On a terminal one line that is overwritten; otherwise a line when a
/// stage is done and every ten seconds in between; or nothing.
class ProgressPrinter {
 public:
  enum class Style { kQuiet, kLines, kTerminal };
  using Clock = std::function<double()>;  ///< seconds since any moment

  ProgressPrinter(std::ostream& stream, Style style, Clock clock);

  /// A stage is `done` of `total` steps far. A new stage name, or fewer steps done than before,
  /// begins a new stage; where its first report has some steps done, it began at the last report of
  /// the stage before.
  void Report(const std::string& stage, int64_t done, int64_t total);

  /// Ends the line of the last stage, so that other output can follow.
  void Finish();

 private:
  void BeginStage(const std::string& stage, double start);
  std::string Line() const;
  std::string TimeLeft() const;

  std::ostream& stream_;
  Style style_;
  Clock clock_;
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
