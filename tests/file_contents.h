#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace curvefusion {

/// What a file holds; nothing where there is none, or a folder.
inline std::string FileText(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// What all files below a folder hold, by their paths in it.
inline std::map<std::string, std::string> FileContents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    contents[std::filesystem::relative(entry.path(), folder).string()] = FileText(entry.path());
  }
  return contents;
}

}  // namespace curvefusion
