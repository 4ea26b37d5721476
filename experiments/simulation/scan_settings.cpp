#include "experiments/simulation/scan_settings.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "experiments/options_json.h"
#include "kernel/error.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

class SettingsReader : public OptionVisitor {
 public:
  SettingsReader(const nlohmann::json& json, std::string source)
      : json_(json), source_(std::move(source)) {}
  void BeginSection(const char* name) override { section_ = std::string(name) + "."; }
  void Visit(const OptionInfo& info, double& value) override { Read(info, value); }
  void Visit(const OptionInfo& info, int& value) override { Read(info, value); }
  void Visit(const OptionInfo& info, bool& value) override { Read(info, value); }

 private:
  template <class Value>
  void Read(const OptionInfo& info, Value& value) {
    value = json_.at(section_ + info.name).get<Value>();
    if (static_cast<double>(value) >= info.min && static_cast<double>(value) <= info.max) return;
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}{} = {} is not within {} to {}", source_,
                                                  section_, info.name, value, info.min, info.max));
  }

  const nlohmann::json& json_;
  std::string source_;
  std::string section_;
};

// The caller's own object, which has no name that says all.
Json CurvesJson(const std::vector<WireCurve>& curves) {
  Json json = Json::array();
  for (const WireCurve& curve : curves) {
    Json points = Json::array();
    for (const Vec3& p : curve.points) points.push_back({p.x(), p.y(), p.z()});
    json.push_back({{"diameter", curve.diameter}, {"points", points}});
    if (!curve.diameters.empty()) json.back()["diameters"] = curve.diameters;
  }
  return json;
}

Json ShapeSeedJson(const SimulationOptions& scan) {
  return scan.object_options.shape_seed ? Json(*scan.object_options.shape_seed) : Json(nullptr);
}

Json ScanJson(const SimulationOptions& scan) {
  Json json = {{"simulator", kSimulatorVersion},
               {"object", scan.object},
               {"shape_seed", ShapeSeedJson(scan)},
               {"sensor", scan.sensor},
               {"pose_source", scan.pose_source},
               {"registration", RegistrationName(scan.color.registration)},
               {"light", LightName(scan.scene.light)},
               {"seed", scan.seed},
               {"options", OptionsJson(scan)},
               {"curves", CurvesJson(scan.object_options.curves)}};
  if (scan.scene.table_gap) json["table_gap"] = *scan.scene.table_gap;
  return json;
}

// Throws nlohmann's exceptions for what is not there or of another type.
std::vector<WireCurve> CurvesOf(const nlohmann::json& json) {
  std::vector<WireCurve> curves;
  for (const nlohmann::json& entry : json) {
    WireCurve& curve = curves.emplace_back();
    entry.at("diameter").get_to(curve.diameter);
    if (entry.contains("diameters")) entry.at("diameters").get_to(curve.diameters);
    for (const nlohmann::json& p : entry.at("points")) {
      curve.points.emplace_back(p.at(0).get<double>(), p.at(1).get<double>(),
                                p.at(2).get<double>());
    }
  }
  return curves;
}

SimulationOptions ScanOf(const nlohmann::json& json, const std::string& source) {
  const int version = json.at("simulator").get<int>();
  if (version != kSimulatorVersion) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is of version {} of the simulator, this is {}; draw the scan anew",
                            source, version, kSimulatorVersion));
  }
  SimulationOptions scan;
  json.at("object").get_to(scan.object);
  json.at("sensor").get_to(scan.sensor);
  json.at("pose_source").get_to(scan.pose_source);
  scan.color.registration = RegistrationOf(json.at("registration").get<std::string>());
  scan.scene.light = LightOf(json.at("light").get<std::string>());
  json.at("seed").get_to(scan.seed);
  if (!json.at("shape_seed").is_null()) {
    scan.object_options.shape_seed = json.at("shape_seed").get<uint64_t>();
  }
  scan.object_options.curves = CurvesOf(json.at("curves"));
  if (json.contains("table_gap")) scan.scene.table_gap = json.at("table_gap").get<double>();
  SettingsReader reader(json.at("options"), source);
  VisitOptions(scan, reader);
  return scan;
}

}  // namespace

std::string ScanSettings(const SimulationOptions& scan) { return ScanJson(scan).dump(); }

SimulationOptions ReadScanSettings(const std::filesystem::path& path) {
  const std::string source = path.string();
  try {
    return ScanOf(ParseJson(ReadFile(path), source), source);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::kBadInput, source + ": tells of no simulated scan: " + error.what());
  }
}

}  // namespace curvefusion
