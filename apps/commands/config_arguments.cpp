#include "apps/commands/config_arguments.h"

#include <CLI/CLI.hpp>

namespace curvefusion {

void AddConfigArguments(CLI::App& command, ConfigArguments& arguments) {
  command.add_option("--profile", arguments.profile,
                     "best (default) or paper: exactly the published method");
  command.add_option("--config", arguments.file, "TOML file; `curvefusion config` prints one");
  command
      .add_option("--set", arguments.assignments,
                  "One setting as section.key=value; may be given several times")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

ConfigSources Sources(const ConfigArguments& arguments) {
  ConfigSources sources;
  if (!arguments.profile.empty()) sources.profile = ProfileNamed(arguments.profile);
  sources.file = arguments.file;
  sources.assignments = arguments.assignments;
  return sources;
}

}  // namespace curvefusion
