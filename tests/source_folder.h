#pragma once

#include <filesystem>

namespace curvefusion {

/// The folder this project was configured in. Only the file that defines it is compiled with that
/// path, so that a compiler cache serves the tests of another clone too.
std::filesystem::path SourceFolder();

}  // namespace curvefusion
