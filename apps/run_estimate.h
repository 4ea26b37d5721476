#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fusion/reconstruction.h"

namespace curvefusion {

/// How long a run of several stages goes on: expected costs of the stages, times how much slower or
/// faster than expected those so far were, those of the same name above all.
class RunEstimate {
 public:
  /// All stages of the run in their order. May be told again with costs that are better known.
  void Plan(const std::vector<PlannedStage>& stages);

  /// A stage is `done` of `total` steps far, `now` seconds after any moment. Where it is another
  /// one than before, those planned before it are taken for left out.
  void Report(const std::string& stage, int64_t done, int64_t total, double now);

  /// Seconds to the end of the last planned stage; nothing before anything is known.
  std::optional<double> SecondsLeft(double now) const;

 private:
  void Begin(const std::string& stage, double now);
  // Stages that are over.
  struct Spent {
    double planned = 0;
    double taken = 0;
  };

  double Cost() const;  // of the stage that runs
  double Rate(double now) const;
  double RateOf(const std::string& stage, double rate) const;

  std::vector<PlannedStage> plan_;
  size_t next_ = 0;          // in the plan: the first that has not begun
  bool is_planned_ = false;  // whether the stage that runs is in the plan, the one before `next_`
  double start_ = 0;
  double steps_start_ = 0;  // when its first step began; there may be work without steps before
  double share_ = 0;        // of it that is done; 0 where it does not tell
  std::string stage_;
  int64_t done_ = 0;
  Spent all_;
  std::map<std::string, Spent> of_name_;
};

}  // namespace curvefusion
