#include "experiments/studies/case_settings.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

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

// The caller's own object, which has no name that says all.
Json CurvesJson(const std::vector<WireCurve>& curves) {
  Json json = Json::array();
  for (const WireCurve& curve : curves) {
    Json points = Json::array();
    for (const Vec3& p : curve.points) points.push_back({p.x(), p.y(), p.z()});
    json.push_back({{"diameter", curve.diameter}, {"points", points}});
  }
  return json;
}

Json ScanJson(const SimulationOptions& scan) {
  return {{"simulator", kSimulatorVersion},
          {"object", scan.object},
          {"sensor", scan.sensor},
          {"pose_source", scan.pose_source},
          {"registration", RegistrationName(scan.color.registration)},
          {"light", LightName(scan.scene.light)},
          {"seed", scan.seed},
          {"options", OptionsJson(scan)},
          {"curves", CurvesJson(scan.object_options.curves)}};
}

}  // namespace

std::string ScanSettings(const SimulationOptions& scan) { return ScanJson(scan).dump(); }

std::string CaseSettings(const StudyCase& study_case) {
  Json labels;
  for (const auto& [name, value] : study_case.labels) labels[name] = value;
  const Json scan = study_case.scan ? ScanJson(*study_case.scan) : Json(nullptr);
  return Json({{"labels", labels},
               {"seed", study_case.seed},
               {"scan", scan},
               {"profile", ProfileName(study_case.config.profile)},
               {"config", OptionsJson(study_case.config)}})
      .dump();
}

std::string SettingsKey(const std::string& settings) {
  uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, 64 bits: offset basis and prime
  for (const unsigned char c : settings) hash = (hash ^ c) * 0x100000001b3;
  return fmt::format("{:016x}", hash);
}

}  // namespace curvefusion
