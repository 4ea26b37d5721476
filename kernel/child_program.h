#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace curvefusion {

/// How a program ended, and what it printed.
struct ProgramResult {
  bool succeeded = false;  ///< it could be started, and its exit code is 0
  std::string output;
  std::string messages;  ///< of its standard error
};

/// Runs a program of the PATH with these arguments in `folder`, without a shell and without input,
/// and calls `meanwhile` ten times a second until it ends. Where that throws, the program is killed
/// and the exception passes on.
ProgramResult RunProgram(const std::string& program, const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder,
                         const std::function<void()>& meanwhile = {});

}  // namespace curvefusion
