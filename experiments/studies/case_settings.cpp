#include "experiments/studies/case_settings.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/simulation/scan_settings.h"
#include "kernel/fnv_hash.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

// Options as JSON, with their sections.
class JsonVisitor : public OptionVisitor {
 public:
  void BeginSection(const char* name) override { section_ = std::string(name) + "."; }
  void Visit(const OptionInfo& info, double& value) override { Add(info, value); }
  void Visit(const OptionInfo& info, int& value) override { Add(info, value); }
  void Visit(const OptionInfo& info, bool& value) override { Add(info, value); }
  const Json& json() const { return json_; }

 private:
  template <class Value>
  void Add(const OptionInfo& info, Value value) {
    json_[section_ + info.name] = value;
  }

  std::string section_;
  Json json_;
};

template <class Options>
Json OptionsJson(Options options) {
  JsonVisitor visitor;
  VisitOptions(options, visitor);
  return visitor.json();
}

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
