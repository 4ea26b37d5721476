#include "experiments/config.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "apps/commands/command.h"
#include "apps/commands/config_arguments.h"

namespace curvefusion {

void AddConfigCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "config", "Print every setting with its value, unit, range and meaning, as a TOML file");
  const auto arguments = std::make_shared<ConfigArguments>();
  AddConfigArguments(*command, *arguments);
  command->footer(
      "Example:\n  curvefusion config > my.toml\n"
      "  curvefusion config --profile paper --set volume.voxel_size=0.01");
  command->callback([arguments, &exit_code] {
    fmt::print("{}", ConfigToml(ReadConfig(Sources(*arguments))));
    exit_code = 0;
  });
}

}  // namespace curvefusion
