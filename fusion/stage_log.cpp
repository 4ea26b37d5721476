#include "fusion/stage_log.h"

#include <algorithm>

namespace curvefusion {

StageReport& StageLog::Stage(const std::string& name) {
  const auto found = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const StageReport& stage) { return stage.name == name; });
  if (found != stages_.end()) return *found;
  stages_.push_back({.name = name});
  return stages_.back();
}

void StageLog::Count(const std::string& stage, const std::string& what, double value) {
  CountOf(stage, what) = value;
}

void StageLog::CountMore(const std::string& stage, const std::string& what, double more) {
  CountOf(stage, what) += more;
}

double& StageLog::CountOf(const std::string& stage, const std::string& what) {
  std::vector<std::pair<std::string, double>>& counts = Stage(stage).counts;
  const auto found = std::find_if(counts.begin(), counts.end(),
                                  [&](const auto& entry) { return entry.first == what; });
  return found != counts.end() ? found->second : counts.emplace_back(what, 0).second;
}

}  // namespace curvefusion
