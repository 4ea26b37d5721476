#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fusion/reconstruction.h"

namespace curvefusion {

/// Follows a run through its plan as the estimate of the time left does.
struct PlanFollower : PipelineObserver {
  std::vector<PlannedStage> plan;
  size_t next = 0;
  std::string stage;
  int64_t done_before = 0;
  std::vector<std::string> unplanned, left_out;  // of these those that were to take time

  void OnPlan(const std::vector<PlannedStage>& stages) override { plan = stages; }
  void OnProgress(const std::string& name, int64_t done, int64_t /*total*/) override {
    const bool is_same = name == stage && done >= done_before;
    done_before = done;
    if (is_same) return;
    stage = name;
    size_t at = next;
    while (at < plan.size() && plan[at].name != name) ++at;
    if (at == plan.size()) {
      unplanned.push_back(name);
      return;
    }
    for (; next < at; ++next)
      if (plan[next].cost > 0) left_out.push_back(plan[next].name);
    ++next;
  }
};

}  // namespace curvefusion
