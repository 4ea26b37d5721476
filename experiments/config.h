#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fusion/pipeline.h"
#include "meshing/tubes.h"

namespace curvefusion {

/// Everything that decides what a run does: the profile and the options of every stage.
struct Config {
  Profile profile = Profile::kBest;
  PipelineOptions pipeline;
  TubeOptions tubes;
};
void VisitOptions(Config& config, OptionVisitor& visitor);

/// An option and what it is set to.
struct OptionValue {
  std::string name;         ///< with its section: "volume.voxel_size"
  std::string value;        ///< as the config file writes it
  std::string unit;         ///< empty for pure numbers
  std::string description;  ///< one sentence
  std::string initial;      ///< what its profile starts from
};

/// The options that are not as their profile starts from, in their order.
std::vector<OptionValue> ChangedOptions(const Config& config);

/// What a profile starts from.
Config ProfileConfig(Profile profile);

/// "paper" or "best".
std::string ProfileName(Profile profile);

/// The profile of that name. Throws Error(kUsage) naming the nearest one.
Profile ProfileNamed(const std::string& name);

/// Where a config comes from; each level overrides those before: profile, file, assignments.
struct ConfigSources {
  std::optional<Profile> profile;        ///< otherwise the file's `profile`, otherwise "best"
  std::filesystem::path file;            ///< a TOML file; empty = none
  std::vector<std::string> assignments;  ///< "section.key=value", in order
};

/// Reads the effective config. Throws Error(kUsage) that names the file and line or the assignment,
/// and the nearest name for an unknown one, the type for a wrong one, range and unit for a value
/// out of range or two that do not fit each other.
Config ReadConfig(const ConfigSources& sources);

/// The config as TOML, each option with what it is, its unit and its range; ReadConfig reads the
/// same config back from it.
std::string ConfigToml(const Config& config);

}  // namespace curvefusion
