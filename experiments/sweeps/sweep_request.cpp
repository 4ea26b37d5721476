#include "experiments/sweeps/sweep_request.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <limits>

#include "experiments/config_value.h"
#include "experiments/simulation/depth_sensor.h"
#include "experiments/simulation/drift.h"
#include "experiments/simulation/families/scan_draw.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

using Names = std::vector<std::string>;

constexpr double kAnyNumber = std::numeric_limits<double>::max();

// A table of the study file that knows how its messages name it. Every key has to be read: at the
// end of a table, what is left is one that there is not.
class StudyTable {
 public:
  StudyTable(const toml::table& table, std::string place) : table_(table), place_(place) {}

  [[noreturn]] void Refuse(const std::string& why) const {
    throw Error(ErrorKind::kUsage, place_ + ": " + why);
  }

  const toml::node* Find(const std::string& key) {
    known_.push_back(key);
    return table_.get(key);
  }

  void ReadNumber(const std::string& key, double least, double greatest, double& value) {
    const toml::node* node = Find(key);
    if (node == nullptr) return;
    const auto number = node->value<double>();
    if (!number || !(*number >= least && *number <= greatest)) {
      Refuse(fmt::format("{} must be a number from {} to {}", key, least, greatest));
    }
    value = *number;
  }

  template <class Integer>
  void ReadInteger(const std::string& key, int least, int greatest, Integer& value) {
    const toml::node* node = Find(key);
    if (node == nullptr) return;
    const toml::value<int64_t>* number = node->as_integer();
    if (number == nullptr || number->get() < least || number->get() > greatest) {
      Refuse(fmt::format("{} must be a whole number from {} to {}", key, least, greatest));
    }
    value = static_cast<Integer>(number->get());
  }

  void ReadBool(const std::string& key, bool& value) {
    const toml::node* node = Find(key);
    if (node == nullptr) return;
    if (!node->is_boolean()) Refuse(key + " must be true or false");
    value = *node->value<bool>();
  }

  void ReadName(const std::string& key, std::string& value) {
    const toml::node* node = Find(key);
    if (node == nullptr) return;
    if (!node->is_string()) Refuse(key + " must be a text in quotes");
    value = *node->value<std::string>();
  }

  // A list of names that there are.
  void ReadNames(const std::string& key, const Names& known, Names& names) {
    const toml::node* node = Find(key);
    if (node == nullptr) return;
    if (!node->is_array()) Refuse(key + " must be a list of texts");
    names.clear();
    for (const toml::node& entry : *node->as_array()) {
      const std::string name = entry.value<std::string>().value_or("");
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        Refuse(fmt::format("{}: there is no {}; did you mean {}?", key, name,
                           NearestName(name, known)));
      }
      names.push_back(name);
    }
  }

  // The table under a key, empty where there is none.
  StudyTable Table(const std::string& key) {
    static const toml::table kEmpty;
    const toml::node* node = Find(key);
    if (node != nullptr && !node->is_table()) Refuse(fmt::format("write [{}], a table", key));
    return {node == nullptr ? kEmpty : *node->as_table(), place_ + " [" + key + "]"};
  }

  void RefuseOtherKeys() const {
    for (const auto& [key, value] : table_) {
      const std::string name(key.str());
      if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
      Refuse(fmt::format("there is no {}; did you mean {}?", name, NearestName(name, known_)));
    }
  }

  // Calls visit(name, node) for every "section.key" of a table of settings.
  template <class Visit>
  void ForEachSetting(const Visit& visit) const {
    for (const auto& [section, keys] : table_) {
      if (!keys.is_table()) Refuse(fmt::format("{} needs its section", section.str()));
      for (const auto& [key, node] : *keys.as_table()) {
        visit(fmt::format("{}.{}", section.str(), key.str()), node);
      }
    }
  }

  const toml::table& toml() const { return table_; }
  const std::string& place() const { return place_; }

 private:
  const toml::table& table_;
  std::string place_;
  Names known_;
};

std::string ValueText(const toml::node& node, const std::string& name, const StudyTable& table) {
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  table.Refuse(name + " must be a number, true or false");
}

void AddGrid(const StudyTable& grid, std::vector<SettingPoint>& points) {
  std::vector<std::pair<std::string, Names>> values;
  grid.ForEachSetting([&](const std::string& name, const toml::node& node) {
    if (!node.is_array()) grid.Refuse(name + " must be a list of values");
    Names texts;
    for (const toml::node& value : *node.as_array()) texts.push_back(ValueText(value, name, grid));
    if (texts.empty()) grid.Refuse(name + " has no value");
    values.emplace_back(name, texts);
  });
  if (values.empty()) return;
  const std::vector<SettingPoint> more = GridPoints(values);
  points.insert(points.end(), more.begin(), more.end());
}

void AddListed(StudyTable& study, std::vector<SettingPoint>& points) {
  const toml::node* node = study.Find("points");
  if (node == nullptr) return;
  if (!node->is_array_of_tables()) study.Refuse("write [[points]], a table for every point");
  for (const toml::node& entry : *node->as_array()) {
    const StudyTable listed(*entry.as_table(), study.place() + " [[points]]");
    SettingPoint& point = points.emplace_back();
    listed.ForEachSetting([&](const std::string& name, const toml::node& value) {
      point.push_back(name + "=" + ValueText(value, name, listed));
    });
  }
}

SettingRange RangeOf(const std::string& name, const toml::node& node, const StudyTable& ranges) {
  const toml::table* ends = node.as_table();
  if (ends == nullptr || !ends->contains("from") || !ends->contains("to")) {
    ranges.Refuse(name + " must be { from = A, to = B }");
  }
  StudyTable table(*ends, ranges.place() + " " + name);
  SettingRange range{name};
  table.ReadNumber("from", -kAnyNumber, kAnyNumber, range.from);
  table.ReadNumber("to", -kAnyNumber, kAnyNumber, range.to);
  table.ReadBool("log", range.log);
  table.RefuseOtherKeys();
  return range;
}

void AddSamples(StudyTable sample, Profile profile, std::vector<SettingPoint>& points) {
  if (sample.toml().empty()) return;
  SampleOptions options;
  std::string method = "sobol";
  sample.ReadName("method", method);
  options.sampling = SamplingNamed(method);
  // Chosen: far more than a study of hours can measure, and few enough to be listed.
  constexpr int kMostPoints = 100000;
  sample.ReadInteger("points", 1, kMostPoints, options.points);
  sample.ReadInteger("seed", 0, std::numeric_limits<int>::max(), options.seed);
  std::vector<SettingRange> ranges;
  const StudyTable box = sample.Table("ranges");
  box.ForEachSetting([&](const std::string& name, const toml::node& node) {
    ranges.push_back(RangeOf(name, node, box));
  });
  sample.RefuseOtherKeys();
  if (options.points == 0 || ranges.empty()) sample.Refuse("needs points and [sample.ranges]");
  const auto more = SampledPoints(ranges, options, profile);
  points.insert(points.end(), more.begin(), more.end());
}

void ReadScans(StudyTable& study, SweepRequest& request) {
  study.ReadNames("objects", ObjectNames(), request.objects);
  study.ReadNames("families", FamilyNames(), request.families);
  study.ReadNames("sensors", SensorNames(), request.sensors);
  study.ReadNames("poses", PoseSourceNames(), request.poses);
  study.ReadInteger("frames", 1, 100000, request.frames);
  study.ReadInteger("seeds", 1, 99, request.seeds);
  std::string split = SplitName(request.split);
  study.ReadName("split", split);
  request.split = SplitNamed(split);
  if (request.objects.empty() && request.families.empty()) {
    study.Refuse("names no scans: objects = [\"cage\"] or families = [\"tree\"]");
  }
}

// What has chosen a constant says nothing about it any more.
void RefuseTuningOn(Split split, const StudyTable& study) {
  if (split == Split::kTrain) return;
  const std::string name = SplitName(split);
  study.Refuse("compares settings on the " + name +
               " split, and constants that were chosen there say nothing about it; use "
               "split = \"train\", or leave [grid], [[points]] and [sample] out");
}

SweepRequest RequestOf(StudyTable study) {
  SweepRequest request;
  Names profiles = {"best"};
  study.ReadNames("profiles", {"paper", "best"}, profiles);
  request.profiles.clear();
  for (const std::string& profile : profiles) request.profiles.push_back(ProfileNamed(profile));
  if (request.profiles.empty()) study.Refuse("profiles is empty");
  ReadScans(study, request);
  AddGrid(study.Table("grid"), request.points);
  AddListed(study, request.points);
  AddSamples(study.Table("sample"), request.profiles.front(), request.points);
  study.ReadInteger("threads", 1, 1024, request.threads);
  study.ReadInteger("shards", 1, 1000, request.shards);
  study.ReadInteger("memory_mb", 1, 10'000'000, request.memory_mb);
  study.RefuseOtherKeys();
  if (request.points.size() > 1) RefuseTuningOn(request.split, study);
  return request;
}

}  // namespace

SweepRequest ReadSweepRequest(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  RefuseControlCharacters(text, path.string());
  try {
    const toml::table table = toml::parse(text);
    return RequestOf({table, path.string()});
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::kUsage, fmt::format("{}:{}: not valid TOML: {}", path.string(),
                                               error.source().begin.line, error.description()));
  }
}

}  // namespace curvefusion
