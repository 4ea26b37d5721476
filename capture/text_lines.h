#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curvefusion {

/// A line of a text file, split at blanks, tabs and commas.
struct TextLine {
  int number = 0;  ///< counted from 1
  std::vector<std::string> fields;
};

/// All lines of a file with at least one field; what follows a '#' is left out. Throws
/// Error(kBadInput) where the file cannot be read.
std::vector<TextLine> ReadTextLines(const std::filesystem::path& path);

}  // namespace curvefusion
