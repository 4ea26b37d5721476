#include "experiments/studies/case_settings.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/options_json.h"
#include "experiments/simulation/scan_settings.h"
#include "kernel/fnv_hash.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string CaseSettings(const StudyCase& study_case) {
  Json labels;
  for (const auto& [name, value] : study_case.labels) labels[name] = value;
  const Json scan = study_case.scan ? Json::parse(ScanSettings(*study_case.scan)) : Json(nullptr);
  return Json({{"labels", labels},
               {"seed", study_case.seed},
               {"scan", scan},
               {"recording", study_case.recording.string()},
               {"profile", ProfileName(study_case.config.profile)},
               {"config", OptionsJson(study_case.config)}})
      .dump();
}

std::string SettingsKey(const std::string& settings) {
  FnvHash hash;
  hash.Add(settings);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace curvefusion
