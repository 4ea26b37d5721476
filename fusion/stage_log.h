#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernel/peak_memory.h"

namespace curvefusion {

/// What a stage cost and found, for the report.
struct StageReport {
  std::string name;
  double seconds = 0;
  int64_t peak_memory = 0;                             ///< of the process until its end, bytes
  std::vector<std::pair<std::string, double>> counts;  ///< e.g. {"points", 48210}
  std::string remark;                                  ///< a sentence where counts do not tell all
};

/// Collects what stages cost and find, in the order in which they first begin.
class StageLog {
 public:
  /// Adds the time until its end of life to a stage, which may be entered several times.
  class Timer {
   public:
    Timer(StageLog& log, std::string stage) : log_(log), stage_(std::move(stage)) {}
    ~Timer() {
      StageReport& stage = log_.Stage(stage_);
      stage.seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
      stage.peak_memory = PeakMemory();
    }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

   private:
    StageLog& log_;
    std::string stage_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };

  /// Sets a count of a stage.
  void Count(const std::string& stage, const std::string& what, double value);

  /// Adds to a count of a stage that is entered several times.
  void CountMore(const std::string& stage, const std::string& what, double more);

  /// Sets the remark of a stage.
  void Remark(const std::string& stage, const std::string& text) { Stage(stage).remark = text; }

  const std::vector<StageReport>& stages() const { return stages_; }

 private:
  StageReport& Stage(const std::string& name);
  double& CountOf(const std::string& stage, const std::string& what);

  std::vector<StageReport> stages_;
};

}  // namespace curvefusion
