#pragma once

#include <filesystem>

#include "tests/source_folder.h"

namespace curvefusion {

/// A file or folder of the shared data, which lies beside the project and is never part of it.
/// Tests that need it skip with a message where it is missing:
///   const auto path = SharedData("clouds/cageB.xyz");
///   if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
inline std::filesystem::path SharedData(const std::filesystem::path& relative) {
  return SourceFolder().parent_path() / "shared" / "data" / relative;
}

}  // namespace curvefusion
