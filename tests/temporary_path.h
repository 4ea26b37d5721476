#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace curvefusion {

/// A path for a test's own files, not shared with tests that run at the same time in other
/// processes.
inline std::filesystem::path TemporaryPath(const std::string& name) {
  return std::filesystem::temp_directory_path() /
         ("curvefusion_" + name + "_" + std::to_string(::getpid()));
}

}  // namespace curvefusion
