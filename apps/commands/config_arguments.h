#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/config.h"

namespace CLI {
class App;
}

namespace curvefusion {

/// The arguments of a command that decide its config.
struct ConfigArguments {
  std::string profile;
  std::filesystem::path file;
  std::vector<std::string> assignments;
};
void AddConfigArguments(CLI::App& command, ConfigArguments& arguments);
ConfigSources Sources(const ConfigArguments& arguments);

}  // namespace curvefusion
