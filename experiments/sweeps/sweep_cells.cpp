#include "experiments/sweeps/sweep_cells.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/config_value.h"
#include "experiments/simulation/families/scan_draw.h"
#include "experiments/studies/case_settings.h"
#include "experiments/studies/provenance.h"
#include "experiments/studies/scan_cache.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

// A scan of the study and what it is called there.
struct StudyScan {
  std::string object;
  uint64_t seed = 1;
  SimulationOptions options;
};

void AddObjectScans(const SweepRequest& request, uint64_t seed, std::vector<StudyScan>& scans) {
  for (const std::string& object : request.objects) {
    for (const std::string& sensor : request.sensors) {
      for (const std::string& poses : request.poses) {
        SimulationOptions scan;
        scan.object = object;
        scan.sensor = sensor;
        scan.pose_source = poses;
        scan.seed = seed;
        if (request.frames > 0) scan.frames = request.frames;
        scans.push_back({object, seed, scan});
      }
    }
  }
}

std::vector<StudyScan> ScansOf(const SweepRequest& request) {
  StudyRequest seeds;
  seeds.seeds = request.seeds;
  seeds.split = request.split;
  std::vector<StudyScan> scans;
  for (const uint64_t seed : SeedsOf(seeds)) {
    AddObjectScans(request, seed, scans);
    for (const std::string& family : request.families) {
      SimulationOptions scan = DrawScan(family, seed);
      if (request.frames > 0) scan.frames = std::min(scan.frames, request.frames);
      scans.push_back({family, seed, scan});
    }
  }
  return scans;
}

// The settings as the config file writes them, without those that change nothing.
std::vector<std::string> NormalSettings(const Config& config) {
  std::vector<std::string> settings;
  for (const OptionValue& option : ChangedOptions(config)) {
    settings.push_back(option.name + "=" + option.value);
  }
  return settings;
}

SweepCell CellOf(const StudyScan& scan, Profile profile, const std::vector<std::string>& settings) {
  SweepCell cell;
  cell.object = scan.object;
  cell.seed = scan.seed;
  cell.sensor = scan.options.sensor;
  cell.poses = scan.options.pose_source;
  cell.profile = profile;
  cell.settings = settings;
  cell.scan = ScanFolder({}, scan.options).string();
  cell.key = CellKey(cell);
  return cell;
}

template <class Value>
Value Entry(const toml::table& table, const char* key, const std::string& source) {
  if (const auto value = table[key].value<Value>()) return *value;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: tells of no cell: it has no {}; plan the sweep again", source, key));
}

SweepCell ParsedParams(const toml::table& table, const std::string& source) {
  SweepCell cell;
  cell.key = Entry<std::string>(table, "cell", source);
  cell.object = Entry<std::string>(table, "object", source);
  cell.seed = static_cast<uint64_t>(Entry<int64_t>(table, "seed", source));
  cell.sensor = Entry<std::string>(table, "sensor", source);
  cell.poses = Entry<std::string>(table, "poses", source);
  cell.profile = ProfileNamed(Entry<std::string>(table, "profile", source));
  cell.scan = Entry<std::string>(table, "scan", source);
  const toml::array* settings = table["settings"].as_array();
  if (settings == nullptr) return cell;
  for (const toml::node& setting : *settings) {
    cell.settings.push_back(setting.value<std::string>().value_or(""));
  }
  return cell;
}

}  // namespace

std::string SettingName(const SweepCell& cell) {
  return cell.settings.empty() ? kDefaultSetting : fmt::format("{}", fmt::join(cell.settings, " "));
}

std::string CellSettings(const SweepCell& cell) {
  const std::string scan_hash = cell.scan.substr(cell.scan.rfind('_') + 1);
  return nlohmann::ordered_json({{"method", MethodVersion()},
                                 {"profile", ProfileName(cell.profile)},
                                 {"settings", cell.settings},
                                 {"scan", scan_hash}})
      .dump();
}

SweepCell CellOfCase(const StudyCase& study_case) {
  const std::string family = LabelOf(study_case.labels, "family");
  const SimulationOptions& scan = study_case.scan.value();
  return CellOf({family.empty() ? scan.object : family, study_case.seed, scan},
                study_case.config.profile, NormalSettings(study_case.config));
}

std::string CellKey(const SweepCell& cell) { return SettingsKey(CellSettings(cell)); }

SweepCells CellsOf(const SweepRequest& request) {
  std::vector<std::pair<Profile, std::vector<std::string>>> choices;
  for (const Profile profile : request.profiles) {
    for (const SettingPoint& point : request.points) {
      choices.emplace_back(profile, NormalSettings(ReadConfig({profile, {}, point})));
    }
  }
  SweepCells result;
  std::set<std::string> keys;
  std::set<std::string> scans;
  for (const StudyScan& scan : ScansOf(request)) {
    for (const auto& [profile, settings] : choices) {
      const SweepCell cell = CellOf(scan, profile, settings);
      if (!keys.insert(cell.key).second) continue;
      if (scans.insert(cell.scan).second) result.scans.push_back(scan.options);
      result.cells.push_back(cell);
    }
  }
  return result;
}

std::string ParamsToml(const SweepCell& cell) {
  std::string text = fmt::format(
      "# A cell of a sweep, which `curvefusion sweep cell` measures. Its name is a hash of "
      "profile,\n"
      "# settings, scan and the method's version ({}).\n"
      "cell = \"{}\"\nobject = \"{}\"\nseed = {}\nsensor = \"{}\"\nposes = \"{}\"\nscan = \"{}\"\n"
      "profile = \"{}\"\nsettings = [",
      MethodVersion(), cell.key, cell.object, cell.seed, cell.sensor, cell.poses, cell.scan,
      ProfileName(cell.profile));
  for (const std::string& setting : cell.settings) text += fmt::format("\n  \"{}\",", setting);
  return text + (cell.settings.empty() ? "]\n" : "\n]\n");
}

SweepCell ReadParams(const std::filesystem::path& path) {
  const std::string source = path.string();
  const std::string text = ReadFile(path);
  RefuseControlCharacters(text, source);
  SweepCell cell;
  try {
    cell = ParsedParams(toml::parse(text), source);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: not valid TOML: {}; plan the sweep again",
                                                  source, error.description()));
  }
  if (CellKey(cell) == cell.key) return cell;
  throw Error(ErrorKind::kBadInput,
              source +
                  ": planned by another version of this program, or edited; plan the sweep "
                  "again, which keeps what is finished");
}

}  // namespace curvefusion
