#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace curvefusion {

/// The extension of a path, with its dot, in lower case: ".ply" of "wires.PLY".
inline std::string LowerCaseExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace curvefusion
