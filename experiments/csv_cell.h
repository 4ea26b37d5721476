#pragma once

#include <string>

namespace curvefusion {

/// A text as a cell of a CSV file: in quotes where it has to be (RFC 4180).
inline std::string CsvCell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace curvefusion
