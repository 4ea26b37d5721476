#include "experiments/config.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "experiments/config_value.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

[[noreturn]] void ThrowUsage(const std::string& message) {
  throw Error(ErrorKind::kUsage, message);
}

std::string Number(double value) { return fmt::format("{}", value); }

std::string Range(const OptionInfo& info) {
  const std::string unit = *info.unit == '\0' ? "" : fmt::format(" {}", info.unit);
  const bool bounded_above = info.max < std::numeric_limits<int>::max();
  return bounded_above ? fmt::format("{} to {}{}", Number(info.min), Number(info.max), unit)
                       : fmt::format("at least {}{}", Number(info.min), unit);
}

// The names of all sections and their keys, in the order they are visited.
class NameCollector : public OptionVisitor {
 public:
  using Section = std::pair<std::string, std::vector<std::string>>;

  void BeginSection(const char* name) override { sections_.push_back({name, {}}); }
  void Visit(const OptionInfo& info, double&) override { Add(info); }
  void Visit(const OptionInfo& info, int&) override { Add(info); }
  void Visit(const OptionInfo& info, bool&) override { Add(info); }
  const std::vector<Section>& sections() const { return sections_; }

 private:
  void Add(const OptionInfo& info) {
    assert(!sections_.empty());
    sections_.back().second.push_back(info.name);
  }

  std::vector<Section> sections_;
};

// A parsed piece of TOML and what messages call its places: "a.toml:12" or "--set a.b=c".
struct Source {
  toml::table table;
  std::string name;
  bool has_lines = false;

  std::string Place(const toml::node& node) const {
    return has_lines ? fmt::format("{}:{}", name, node.source().begin.line) : name;
  }
};

bool Contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Names of options, each with its section, that this one without was meant to be: "min_frames" is
// bundle.min_frames. Empty where there is none of this name.
std::vector<std::string> OptionsCalled(const std::string& key,
                                       const std::vector<NameCollector::Section>& known) {
  std::vector<std::string> found;
  for (const auto& [name, keys] : known) {
    if (Contains(keys, key)) found.push_back(fmt::format("{}.{}", name, key));
  }
  return found;
}

// The best guess at what an unknown key was meant to be: the same key in another section, or the
// nearest one in its own.
std::string MeantKey(const std::vector<NameCollector::Section>& known,
                     const NameCollector::Section& section, const std::string& key) {
  const std::vector<std::string> elsewhere = OptionsCalled(key, known);
  if (!elsewhere.empty()) return elsewhere.front();
  return fmt::format("{}.{}", section.first, NearestName(key, section.second));
}

[[noreturn]] void ThrowNoSection(const std::string& place, const std::string& name,
                                 const std::vector<NameCollector::Section>& known) {
  if (const auto options = OptionsCalled(name, known); !options.empty()) {
    ThrowUsage(fmt::format("{}: {} needs its section: did you mean {}?", place, name,
                           fmt::join(options, " or ")));
  }
  std::vector<std::string> top_level = {"profile"};
  for (const auto& section : known) top_level.push_back(section.first);
  ThrowUsage(fmt::format("{}: there is no section {}; did you mean {}? All: {}", place, name,
                         NearestName(name, top_level), fmt::join(top_level, ", ")));
}

[[noreturn]] void ThrowNoKey(const Source& source, const toml::node& value,
                             const std::string& section) {
  ThrowUsage(fmt::format("{}: {} is a section; {}", source.Place(value), section,
                         source.has_lines ? fmt::format("write [{}] and its keys below", section)
                                          : fmt::format("write {}.key=value", section)));
}

void CheckKeys(const Source& source, const toml::table& table,
               const NameCollector::Section& section,
               const std::vector<NameCollector::Section>& known) {
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (Contains(section.second, name)) continue;
    ThrowUsage(fmt::format("{}: there is no option {}.{}; did you mean {}?", source.Place(value),
                           section.first, name, MeantKey(known, section, name)));
  }
}

void CheckNames(const Source& source, Config config) {
  NameCollector collector;
  VisitOptions(config, collector);
  const auto& known = collector.sections();
  for (const auto& [key, value] : source.table) {
    const std::string name(key.str());
    if (name == "profile") continue;
    const auto section =
        std::find_if(known.begin(), known.end(), [&](const auto& s) { return s.first == name; });
    if (section == known.end()) ThrowNoSection(source.Place(value), name, known);
    if (!value.is_table()) ThrowNoKey(source, value, name);
    CheckKeys(source, *value.as_table(), *section, known);
  }
}

// Overwrites the visited options by what the source says of them.
class OptionReader : public OptionVisitor {
 public:
  explicit OptionReader(const Source& source) : source_(source) {}

  void BeginSection(const char* name) override {
    section_ = name;
    table_ = source_.table[name].as_table();
  }

  void Visit(const OptionInfo& info, double& value) override {
    const toml::node* node = Find(info);
    if (node == nullptr) return;
    if (!node->is_number()) ThrowWrongType(info, *node, "a number");
    value = CheckedRange(info, *node, *node->value<double>());
  }

  void Visit(const OptionInfo& info, int& value) override {
    const toml::node* node = Find(info);
    if (node == nullptr) return;
    if (!node->is_integer()) ThrowWrongType(info, *node, "a whole number");
    const auto read = static_cast<double>(*node->value<int64_t>());
    const double lowest = std::numeric_limits<int>::lowest();
    const double greatest = std::numeric_limits<int>::max();
    CheckedRange(info, *node, read);
    if (read < lowest || read > greatest) ThrowOutOfRange(info, *node, read);
    value = static_cast<int>(read);
  }

  void Visit(const OptionInfo& info, bool& value) override {
    const toml::node* node = Find(info);
    if (node == nullptr) return;
    if (!node->is_boolean()) ThrowWrongType(info, *node, "true or false");
    value = *node->value<bool>();
  }

  void VisitChoice(const OptionInfo& info, const std::vector<std::string>& words,
                   int& value) override {
    const toml::node* node = Find(info);
    if (node == nullptr) return;
    const std::string wanted = fmt::format("one of {}", fmt::join(words, ", "));
    if (!node->is_string()) ThrowWrongType(info, *node, wanted.c_str());
    const auto word = std::find(words.begin(), words.end(), *node->value<std::string>());
    if (word == words.end()) ThrowWrongType(info, *node, wanted.c_str());
    value = static_cast<int>(word - words.begin());
  }

 private:
  const toml::node* Find(const OptionInfo& info) const {
    return table_ == nullptr ? nullptr : table_->get(info.name);
  }

  double CheckedRange(const OptionInfo& info, const toml::node& node, double value) const {
    if (!(value >= info.min && value <= info.max)) ThrowOutOfRange(info, node, value);
    return value;
  }

  [[noreturn]] void ThrowOutOfRange(const OptionInfo& info, const toml::node& node,
                                    double value) const {
    ThrowUsage(fmt::format("{}: {}.{} = {} is out of its range: {}", source_.Place(node), section_,
                           info.name, Number(value), Range(info)));
  }

  [[noreturn]] void ThrowWrongType(const OptionInfo& info, const toml::node& node,
                                   const char* wanted) const {
    ThrowUsage(fmt::format("{}: {}.{}: {}", source_.Place(node), section_, info.name,
                           WrongValueText(node, info, wanted)));
  }

  const Source& source_;
  std::string section_;
  const toml::table* table_ = nullptr;
};

Source ParseFile(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  RefuseControlCharacters(text, path.string());
  try {
    return {toml::parse(text), path.string(), true};
  } catch (const toml::parse_error& error) {
    ThrowUsage(fmt::format("{}:{}: not valid TOML: {}", path.string(), error.source().begin.line,
                           error.description()));
  }
}

Source ParseAssignment(const std::string& assignment) {
  const std::string name = "--set " + assignment;
  RefuseControlCharacters(assignment, name);
  try {
    return {toml::parse(assignment), name, false};
  } catch (const toml::parse_error&) {
    if (const auto table = TextAssigned(assignment)) return {*table, name, false};
    ThrowUsage(
        fmt::format("{}: write section.key=value, for example volume.voxel_size=0.008", name));
  }
}

void Apply(const Source& source, Config& config) {
  CheckNames(source, config);
  OptionReader reader(source);
  VisitOptions(config, reader);
}

Profile FileProfile(const Source& source) {
  const toml::node* node = source.table.get("profile");
  if (node == nullptr) return Profile::kBest;
  if (!node->is_string()) {
    ThrowUsage(fmt::format("{}: profile must be \"paper\" or \"best\"", source.Place(*node)));
  }
  return ProfileNamed(*node->value<std::string>());
}

// TOML tells numbers with a fraction from whole ones.
std::string TomlNumber(double value) {
  const std::string number = Number(value);
  return number.find_first_of(".en") == std::string::npos ? number + ".0" : number;
}

std::string TomlText(const std::string& word) { return fmt::format("\"{}\"", word); }

// All options with their values, in the order they are visited.
class ValueCollector : public OptionVisitor {
 public:
  void BeginSection(const char* name) override { section_ = name; }
  void Visit(const OptionInfo& info, double& value) override { Add(info, TomlNumber(value)); }
  void Visit(const OptionInfo& info, int& value) override { Add(info, std::to_string(value)); }
  void Visit(const OptionInfo& info, bool& value) override { Add(info, value ? "true" : "false"); }
  void VisitChoice(const OptionInfo& info, const std::vector<std::string>& words,
                   int& value) override {
    Add(info, TomlText(words[static_cast<size_t>(value)]));
  }
  const std::vector<OptionValue>& values() const { return values_; }

 private:
  void Add(const OptionInfo& info, const std::string& value) {
    values_.push_back(
        {fmt::format("{}.{}", section_, info.name), value, info.unit, info.description, ""});
  }

  std::string section_;
  std::vector<OptionValue> values_;
};

std::vector<OptionValue> OptionValues(Config config) {
  ValueCollector collector;
  VisitOptions(config, collector);
  return collector.values();
}

// Prints the visited options as TOML tables.
class TomlWriter : public OptionVisitor {
 public:
  void BeginSection(const char* name) override { text_ += fmt::format("\n[{}]\n", name); }

  void Visit(const OptionInfo& info, double& value) override {
    Write(info, TomlNumber(value), Range(info));
  }
  void Visit(const OptionInfo& info, int& value) override {
    Write(info, std::to_string(value), Range(info));
  }
  void Visit(const OptionInfo& info, bool& value) override {
    Write(info, value ? "true" : "false", "true or false");
  }
  void VisitChoice(const OptionInfo& info, const std::vector<std::string>& words,
                   int& value) override {
    Write(info, TomlText(words[static_cast<size_t>(value)]),
          fmt::format("{}", fmt::join(words, ", ")));
  }
  const std::string& text() const { return text_; }

 private:
  void Write(const OptionInfo& info, const std::string& value, const std::string& range) {
    text_ +=
        fmt::format("# {}\n# Range: {}.\n{} = {}\n", info.description, range, info.name, value);
  }

  std::string text_;
};

// Options that must fit each other, so that a run does not end after minutes.
void CheckTogether(const Config& config) {
  const auto* const best = std::get_if<BestOptions>(&config.pipeline);
  if (best == nullptr) return;
  const double truncation = best->volume.voxel_size * best->volume.truncation_voxels;
  const double solid_depth = best->segmentation.opening.solid_depth;
  if (solid_depth < truncation) return;
  ThrowUsage(
      fmt::format("segmentation.solid_depth = {:g} m must be less than volume.voxel_size * "
                  "volume.truncation_voxels = {:g} * {} = {:g} m; set volume.truncation_voxels to "
                  "{} or more",
                  solid_depth, best->volume.voxel_size, best->volume.truncation_voxels, truncation,
                  static_cast<int>(solid_depth / best->volume.voxel_size) + 1));
}

}  // namespace

void VisitOptions(Config& config, OptionVisitor& visitor) {
  VisitOptions(config.pipeline, visitor);
  VisitOptions(config.tubes, visitor);
}

std::vector<OptionValue> ChangedOptions(const Config& config) {
  const std::vector<OptionValue> initial = OptionValues(ProfileConfig(config.profile));
  std::vector<OptionValue> changed;
  size_t i = 0;
  for (OptionValue& option : OptionValues(config)) {
    option.initial = initial[i++].value;
    if (option.value != option.initial) changed.push_back(option);
  }
  return changed;
}

Config ProfileConfig(Profile profile) { return {profile, ProfileOptions(profile), {}}; }

std::string ProfileName(Profile profile) { return profile == Profile::kPaper ? "paper" : "best"; }

Profile ProfileNamed(const std::string& name) {
  for (const Profile profile : {Profile::kPaper, Profile::kBest}) {
    if (ProfileName(profile) == name) return profile;
  }
  ThrowUsage(fmt::format("there is no profile {}; did you mean {}?", name,
                         NearestName(name, {"paper", "best"})));
}

Config ReadConfig(const ConfigSources& sources) {
  std::optional<Source> file;
  if (!sources.file.empty()) file = ParseFile(sources.file);
  const Profile file_profile = file ? FileProfile(*file) : Profile::kBest;
  Config config = ProfileConfig(sources.profile.value_or(file_profile));
  if (file) Apply(*file, config);
  for (const std::string& assignment : sources.assignments) {
    const Source source = ParseAssignment(assignment);
    if (source.table.contains("profile")) ThrowUsage(source.name + ": use --profile instead");
    Apply(source, config);
  }
  CheckTogether(config);
  return config;
}

std::string ConfigToml(const Config& config) {
  TomlWriter writer;
  Config visited = config;
  VisitOptions(visited, writer);
  return fmt::format(
      "# Effective settings of CurveFusion. Lengths are in metres unless the range says otherwise."
      "\n# Use with: curvefusion reconstruct SEQUENCE -o OUT --config FILE\n\n"
      "# What unset options start from: \"paper\" or \"best\".\nprofile = \"{}\"\n{}",
      ProfileName(config.profile), writer.text());
}

}  // namespace curvefusion
